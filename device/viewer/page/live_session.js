// A live view: the page of a servo loop that runs, with hands that move its tool.
import { GamepadHand } from './gamepad.js';
import { HeldPose, PointerHand } from './hand.js';
import { KeyboardHand } from './keyboard.js';
import { LiveSource } from './live_source.js';
import { defaultLook, markScene, sceneLooks, showGallery, showSettings } from './panel.js';
import { flags, sampleIndex, sampleWords } from './protocol.js';
import { traceSeconds } from './trace.js';

const $ = (id) => document.getElementById(id);
const workPeriod = 400;  // of building, after which it can be cancelled [ms]
const fadingPeriod = 0.25;  // between pictures in which nothing but the trace changes [s]

export class LiveSession {
  constructor(page) {
    this.page = page;
    this.source = new LiveSource({
      hello: (hello) => this.hello(hello), gallery: ({ gallery }) => this.setGallery(gallery), stage: (stage) => this.setStage(stage),
      work: ({ text }) => this.showWork(text),
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
    $('show').onclick = () => {
      page.player.goLive();
      this.source.playMotion();
    };
    $('cancel').onclick = () => this.cancel();
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
    this.showWork('');
    this.page.timeline.restart(hello.rate);
    this.page.player.goLive();  // there is no past any more
    this.setGallery(hello.gallery);
  }

  setGallery(gallery) {
    this.greeting.gallery = gallery;
    showGallery($('gallery'), gallery, (request) => this.choose(request));
  }

  choose(request) {
    this.upload?.abort();
    this.upload = null;
    this.hasChosen = this.source.choose(request);
    if (this.hasChosen) return undefined;
    this.page.say('The connection is lost: choose again when it is back.');
    return this.showSettings();
  }

  /** What the program says; where it refuses, the settings are still those of the stage on show. */
  hear(type, text) {
    this.page.say(text);
    if (type !== 'refusal') return;
    this.hasChosen = false;
    this.showSettings();
  }
  showSettings() {
    const stage = this.waiting?.stage ?? this.page.stage;
    if (stage) showSettings($('settings'), this.greeting, stage, (request) => this.choose(request));
  }

  async openMesh(file) {
    if (!file) return;
    const { page } = this, most = this.greeting?.largest_file;
    if (file.size > most) return page.say(`${file.name} is too large: ${most / 2 ** 20} MB is the most. Reduce its triangles first, or start the demo with --object.`);
    this.upload?.abort();
    const upload = this.upload = new AbortController();
    this.hasChosen = true;
    this.showWork(`Sending ${file.name} …`);
    try {
      await this.source.sendFile(file, $('unit').value, upload.signal);
    } catch (problem) {
      if (upload !== this.upload) return undefined;  // something else was chosen
      this.showWork('');
      page.say(problem.message);
    }
    return undefined;
  }
  cancel() {
    this.upload?.abort();
    this.source.cancel();
  }

  /** What is being built, as a sentence; where it takes long it can be cancelled. Empty where nothing is. */
  showWork(text) {
    const { page } = this;
    if (text) page.say(text, true);
    else if ($('sentence').textContent === this.work) page.say('');
    if (!text) this.hasChosen = false;
    this.work = text;
    clearTimeout(this.workTimer);
    if (text) this.workTimer = setTimeout(() => this.offerCancel(true), workPeriod);
    else this.offerCancel(false);
  }
  offerCancel(isOffered) {
    const [cancel, open] = [$('cancel'), $('open-mesh')];
    const hadFocus = [cancel, open].includes(document.activeElement);
    cancel.hidden = !isOffered;
    open.parentElement.hidden = isOffered;
    if (hadFocus) (isOffered ? cancel : open).focus();
  }

  /** A stage that somebody else has chosen waits while the past is looked at here. */
  setStage(stage) {
    const { page } = this;
    if (page.stage && !page.player.isLive && !this.hasChosen) {
      this.waiting = { stage };
      markScene($('gallery'), stage.scene);
      this.showSettings();
      return page.say(`Another page has chosen ${stage.title}: you still see the past, and Live shows it.`, true);
    }
    this.waiting = null;
    this.source.stage = stage.stage;
    if (page.stage) page.say('');
    const isSameScene = page.stage?.scene === stage.scene;
    page.stage = stage;
    page.panes[0].setStage(stage);
    document.title = `Feeler: ${stage.title}`;
    markScene($('gallery'), stage.scene);
    this.showSettings();
    if (!isSameScene) page.setLook({ ...defaultLook, ...sceneLooks[stage.scene] });
    return page.player.goLive();
  }
  catchUp() {
    const { waiting } = this;
    if (!waiting) return;
    this.setStage(waiting.stage);
    if (waiting.mesh) this.setMesh(waiting.mesh);
  }

  setMesh(mesh) {
    if (this.waiting?.stage.stage === mesh.stage) this.waiting.mesh = mesh;
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
