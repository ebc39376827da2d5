// A live view: the page of a servo loop that runs, with hands that move its tool.
import { GamepadHand } from './gamepad.js';
import { HeldPose, PointerHand } from './hand.js';
import { KeyboardHand } from './keyboard.js';
import { LiveSource } from './live_source.js';
import { defaultLook, markScene, sceneLooks, showGallery, showSettings } from './panel.js';
import { flags, sampleIndex, sampleWords } from './protocol.js';
import { traceSeconds } from './trace.js';

const $ = (id) => document.getElementById(id);
const fadingPeriod = 0.25;  // between pictures in which nothing but the trace changes [s]

export class LiveSession {
  constructor(page) {
    this.page = page;
    this.source = new LiveSource({
      hello: (hello) => this.hello(hello), gallery: ({ gallery }) => this.setGallery(gallery), stage: (stage) => this.setStage(stage),
      mesh: (mesh) => this.setMesh(mesh), frame: (frame) => this.addFrame(frame), sentence: (type, text) => this.hear(type, text),
      connection: (state) => this.showConnection(state),
    });
    this.held = new HeldPose(page.view, this.source);
    const pointer = new PointerHand(this.held);
    this.hands = [pointer, new KeyboardHand(this.held, page.view.canvas), new GamepadHand(this.held)];
    $('finger-turns').onclick = () => {
      pointer.turns = !pointer.turns;
      $('finger-turns').setAttribute('aria-pressed', String(pointer.turns));
    };
    $('show').onclick = () => this.source.playMotion();
    $('still').onclick = () => this.source.stopHand();
    $('open-mesh').onchange = ({ target }) => {
      this.openMesh(target.files[0]);
      target.value = '';  // so that the same file can be opened again
    };
  }

  /** For good: recordings are looked at instead. */
  end() {
    this.source.close();
    this.held.isElsewhere = true;
  }

  /** What to do first, until it is done. @param device  the name of a real one that is the hand, or null */
  invite(device) {
    if (this.isInvited) return;
    this.isInvited = true;
    const { page } = this;
    page.say(device ? `You hold the ${device}: press the tool against a wall with its handle; while its first button is down the handle moves alone.`
      : 'Drag the tool against a wall, with the mouse, a finger or the arrow keys; ? tells every way.', true);
    for (const act of ['pointerdown', 'keydown']) page.view.canvas.addEventListener(act, () => page.say(''), { once: true });
  }

  hello(hello) {
    this.greeting = hello;
    this.held.isElsewhere = hello.device !== null;
    document.body.classList.toggle('on-device', hello.device !== null);
    this.invite(hello.device);
    this.page.timeline.restart(hello.rate);
    this.setGallery(hello.gallery);
  }

  setGallery(gallery) {
    this.greeting.gallery = gallery;
    showGallery($('gallery'), gallery, (request) => this.choose(request));
  }

  choose(request) {
    if (this.source.choose(request)) return this.page.say('Building the scene …', true);
    this.page.say('The connection is lost: choose again when it is back.');
    return this.showSettings();
  }

  /** What the program says; where it refuses, the settings are still those of the stage on show. */
  hear(type, text) {
    this.page.say(text);
    if (type === 'refusal') this.showSettings();
  }
  showSettings() {
    const { stage } = this.page;
    if (stage) showSettings($('settings'), this.greeting, stage, (request) => this.choose(request));
  }

  async openMesh(file) {
    if (!file) return;
    const { page } = this, most = this.greeting?.largest_file;
    if (file.size > most) return page.say(`${file.name} is too large: ${most / 2 ** 20} MB is the most. Reduce its triangles first, or start the demo with --object.`);
    page.say(`Opening ${file.name} …`, true);
    try {
      await this.source.sendFile(file);
    } catch (problem) {
      page.say(problem.message);
    }
  }

  setStage(stage) {
    const { page } = this;
    if (page.stage) page.say('');
    const isSameScene = page.stage?.scene === stage.scene;
    page.stage = stage;
    page.panes[0].setStage(stage);
    document.title = `Feeler: ${stage.title}`;
    markScene($('gallery'), stage.scene);
    this.showSettings();
    if (!isSameScene) page.setLook({ ...defaultLook, ...sceneLooks[stage.scene] });
    page.player.goLive();
  }

  setMesh(mesh) {
    if (mesh.stage !== this.page.stage.stage) return;
    this.page.meshBuffer = mesh.buffer;
    this.page.view.setMesh(mesh);
  }

  addFrame(frame) {
    const { page } = this;
    this.noteEvents(page.timeline.latest, frame);
    page.timeline.add(frame);
    if (page.player.isLive && !this.rests(frame)) page.showMoment();
  }

  /** Whether a frame shows what is on show: then none is drawn, but a few a second while the trace fades. */
  rests(frame) {
    const shown = this.page.view.frame;
    const seen = ({ haptic, graphic, force, torque, status }) => [haptic.position, haptic.quaternion, graphic.position, graphic.quaternion, force, torque, status].join();
    if (!shown || shown.stage !== frame.stage || seen(shown) !== seen(frame)) {
      this.lastMove = frame.time;
      return false;
    }
    return frame.time - shown.time < fadingPeriod || frame.time - this.lastMove > traceSeconds + fadingPeriod;
  }

  noteEvents(last, frame) {
    const { timeline } = this.page;
    const types = (f) => f.contacts.map((c) => c.type).join();
    if (last && last.stage === frame.stage && types(last) !== types(frame)) timeline.addEvent(frame.time, 'switch');
    for (let at = 0; at < frame.samples.length; at += sampleWords) {
      const word = frame.samples[at + sampleIndex.flags];
      if (word & flags.folded) timeline.addEvent(frame.samples[at], 'fold');
      if (!(word & flags.converged)) timeline.addEvent(frame.samples[at], 'budget');
    }
  }

  showConnection(state) {
    $('connection').className = state;
    $('connection').querySelector('.text').textContent = state === 'open' ? 'connected' : 'connection lost: trying again …';
  }
}
