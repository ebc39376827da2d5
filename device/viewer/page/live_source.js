// The live end of the wire: a WebSocket that comes back by itself.
import { readMessage } from './protocol.js';

const patience = [250, 500, 1000, 2000];  // between attempts [ms]

/** Hands on what the server tells, and tells it what the user does. Listeners: hello, gallery, stage, work, mesh, frame, sentence, connection. */
export class LiveSource {
  constructor(listeners) {
    this.listeners = listeners;
    this.attempt = 0;
    this.stage = 0;  // that is meant by what the hand is told
    this.connect();
  }

  connect() {
    if (this.isClosed) return;
    const url = new URL('/live', location.href);
    url.protocol = 'ws:';
    url.search = location.search;  // with the token
    this.socket = new WebSocket(url);
    this.socket.binaryType = 'arraybuffer';
    this.socket.onopen = () => {
      this.attempt = 0;
      this.listeners.connection('open');
    };
    this.socket.onmessage = ({ data }) => this.read(data);
    this.socket.onclose = () => this.comeBack();
  }

  close() {
    this.isClosed = true;
    this.socket.onclose = null;
    this.socket.close();
  }

  comeBack() {
    this.listeners.connection('lost');
    const wait = patience[Math.min(this.attempt++, patience.length - 1)];
    setTimeout(() => this.connect(), wait);
  }

  read(data) {
    if (typeof data === 'string') return this.readText(JSON.parse(data));
    try {
      const message = readMessage(data);
      this.listeners[message.kind](message);
    } catch (problem) {
      this.listeners.sentence('refusal', problem.message);
    }
  }

  readText(message) {
    if (['hello', 'gallery', 'stage', 'work'].includes(message.type)) this.listeners[message.type](message);
    else this.listeners.sentence(message.type, message.text ?? message.reason);
  }

  /** @return whether there is a connection */
  send(message) {
    const isOpen = this.socket.readyState === WebSocket.OPEN;
    if (isOpen) this.socket.send(JSON.stringify(message));
    return isOpen;
  }
  /** The hand to a pose: position [m] and quaternion x, y, z, w. */
  moveHand({ position, quaternion: [x, y, z, w] }) {
    this.send({ type: 'hand', stage: this.stage, position, orientation: [w, x, y, z] });
  }
  stopHand() {
    this.send({ type: 'still', stage: this.stage });
  }
  playMotion() {
    this.send({ type: 'motion', stage: this.stage });
  }
  choose(request) {
    return this.send({ type: 'scene', ...request });
  }
  cancel() {
    this.send({ type: 'cancel' });
  }
  /** A mesh, to become a scene. @param unit  of its numbers; empty to have it guessed  @throws Error with a sentence where it is not taken */
  async sendFile(file, unit, signal) {
    const url = new URL('/file', location.href);
    url.search = location.search;
    url.searchParams.set('name', file.name);
    url.searchParams.set('unit', unit);
    let response;
    try {
      response = await fetch(url, { method: 'POST', body: file, signal });
    } catch {
      if (signal.aborted) throw new Error(`${file.name} was not opened.`);
      throw new Error(`${file.name} could not be sent: is the connection lost, or the file gone?`);
    }
    if (!response.ok) throw new Error(await response.text());
  }
}
