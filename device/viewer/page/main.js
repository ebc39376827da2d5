// The page: a live view of the servo loop, or recordings that need no server.
import { LiveSession } from './live_session.js';
import { palettes } from './palette.js';
import { Pane } from './pane.js';
import { defaultLook, sceneLooks, showLook } from './panel.js';
import { Player } from './player.js';
import { readRecording, writeRecording } from './recording.js';
import { csvOf, download, pngOf } from './save.js';
import { counted } from './format.js';
import { countTicks, Strips } from './strips.js';
import { Timeline } from './timeline.js';

const $ = (id) => document.getElementById(id);
const stripPeriod = 120, slowStripPeriod = 300;  // between drawings of the strips, and where pixels are slow [ms]
const restAfter = 500;     // without a new picture [ms]

class Page {
  constructor() {
    this.timeline = new Timeline();
    this.panes = [new Pane($('first'), this.timeline)];
    this.strips = new Strips($('strips'));
    this.recordings = [];
    this.isDirty = true;
    this.lastStrips = 0;
    this.lastPicture = 0;
    this.setTheme(localStorageValue('theme') ?? (matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light'));
    this.listen();
    requestAnimationFrame(() => this.draw());
  }

  get shownPanes() {
    return this.panes.filter(({ section }) => !section.hidden);
  }
  get view() {
    return this.panes[0].view;
  }

  listen() {
    $('theme').onclick = () => this.setTheme(this.theme === 'dark' ? 'light' : 'dark');
    $('help').onclick = () => this.showHelp($('help-text').hidden);
    $('help-close').onclick = () => this.showHelp(false);
    $('save-png').onclick = () => this.savePicture();
    $('save-csv').onclick = () => download(this.fileName('csv'), new Blob([csvOf(this.timeline)], { type: 'text/csv' }));
    $('save-recording').onclick = () => this.saveRecording();
    $('open-recording').onchange = ({ target }) => {
      this.openFiles([...target.files]);
      target.value = '';  // so that the same file can be opened again
    };
    $('window').onchange = (event) => {
      this.strips.window = Number(event.target.value);
      this.askForStrips();
    };
    this.strips.onPick = (time) => this.player.pauseAt(time);
    addEventListener('dragover', (event) => event.preventDefault());
    addEventListener('drop', (event) => {
      event.preventDefault();
      const folder = [...event.dataTransfer.items].map((item) => item.webkitGetAsEntry?.()).find((entry) => entry?.isDirectory);
      if (folder) this.say(`${folder.name} is a folder: drop the file that is in it.`);
      else this.openFiles([...event.dataTransfer.files]);
    });
    for (const pane of this.panes) pane.view.changed = () => (this.isDirty = true);
  }

  showHelp(isShown) {
    $('help-text').hidden = !isShown;
    $('help').setAttribute('aria-expanded', String(isShown));
  }

  setTheme(name) {
    this.theme = name;
    document.documentElement.dataset.theme = name;
    keepLocally('theme', name);
    for (const pane of this.panes) pane.view.setTheme(name);
    this.askForStrips();
    this.isDirty = true;
  }

  /** A sentence that goes when it has been read, unless it is asked to stay. */
  say(text, stays = false) {
    clearTimeout(this.sentenceTimer);
    $('sentence').textContent = text;
    $('sentence').hidden = !text;
    if (text && !stays) this.sentenceTimer = setTimeout(() => ($('sentence').hidden = true), Math.max(6000, 60 * text.length));
  }

  makePlayer(timeline, isReplay) {
    const elements = Object.fromEntries(['pause', 'live', 'back', 'forth', 'clock', 'speed'].map((id) => [id, $(id)]));
    this.player = new Player(timeline, { ...elements, slider: $('time') }, isReplay);
    this.player.onChange = () => {
      this.areStripsOld = true;
      if (this.player.isLive) this.live?.catchUp();
      this.showMoment();
    };
  }

  goLive() {
    this.makePlayer(this.timeline, false);
    this.live = new LiveSession(this);
  }

  /** @param recordings  one, or two to be seen side by side */
  replay(recordings) {
    this.live?.end();
    this.say('');
    document.body.classList.add('replay');
    this.recordings = recordings.slice(0, 2);
    this.timeline = this.recordings[0].timeline;
    if (this.recordings.length === 2 && this.panes.length === 1) this.addPane();
    $('second').hidden = this.recordings.length < 2;
    this.makePlayer(this.recordings.map(({ timeline }) => timeline).reduce((a, b) => (b.end > a.end ? b : a)), true);
    if (this.live) this.offerWayBack();
    this.recordings.forEach(({ stage, mesh, timeline }, i) => {
      const pane = this.panes[i];
      pane.timeline = timeline;
      pane.setStage(stage);
      pane.view.setMesh(mesh);
    });
    this.stage = this.recordings[0].stage;
    document.title = `Feeler: ${this.stage.title}`;
    $('connection').className = 'open';
    $('connection').querySelector('.text').textContent = this.recordings.length === 2 ? 'two recordings' : 'a recording';
    this.setLook({ ...defaultLook, ...sceneLooks[this.stage.scene] });
    const { begin, end } = this.player.timeline;
    this.strips.window = Math.min(10, Math.max(1, end - begin));
    this.player.seek(begin);
  }

  /** From recordings to the loop that runs on. */
  offerWayBack() {
    $('live').hidden = false;
    $('live').onclick = () => location.reload();
  }

  addPane() {
    const second = new Pane($('second'), this.recordings[1].timeline);
    this.panes.push(second);
    second.view.setTheme(this.theme);
    const [a, b] = this.panes.map((pane) => pane.view);
    const copy = (from, to) => {
      to.camera.position.copy(from.camera.position);
      to.camera.quaternion.copy(from.camera.quaternion);
      to.controls.target.copy(from.controls.target);
      this.isDirty = true;
    };
    a.changed = b.changed = () => (this.isDirty = true);
    a.controls.addEventListener('change', () => copy(a, b));
    b.controls.addEventListener('change', () => copy(b, a));
  }

  async openFiles(files) {
    const meshes = files.filter(({ name }) => !/\.json$/i.test(name));
    if (meshes.length > 0) {
      if (this.live && this.recordings.length === 0) return this.live.openMesh(meshes[0]);
      return this.say('A mesh is opened in the live view: ./run demo --view.');
    }
    try {
      const opened = [];
      for (const file of files) opened.push(readRecording(await file.text()));
      if (opened.length === 1 && this.recordings.length === 1) opened.unshift(this.recordings[0]);
      if (opened.length > 0) this.replay(opened);
    } catch (problem) {
      this.say(problem.message);
    }
    return undefined;
  }

  setLook(values) {
    showLook($('look'), values, (changed) => this.applyLook(changed));
    $('look').elements.reset.onclick = () => {
      for (const pane of this.panes) pane.view.resetCamera();
      this.isDirty = true;
    };
    this.applyLook(values);
  }
  applyLook(values) {
    this.look = values;
    for (const pane of this.panes) pane.setLook(values);
    this.isDirty = true;
  }

  showMoment() {
    for (const pane of this.shownPanes) pane.show(this.player.isLive ? pane.timeline.frames.length - 1 : pane.timeline.frameIndexAt(this.player.cursor));
  }

  draw() {
    requestAnimationFrame(() => this.draw());  // first: a picture that fails is not the last one
    this.player?.advance();
    if (this.isDirty) {
      this.isDirty = false;
      for (const pane of this.shownPanes) pane.draw();
      this.lastPicture = performance.now();
    } else if (performance.now() - this.lastPicture > restAfter) {
      for (const pane of this.shownPanes) pane.view.drawAtRest();
    }
    const now = performance.now();
    if (this.player && now - this.lastStrips > (this.view.isSlow ? slowStripPeriod : stripPeriod) && (this.player.isLive || this.areStripsOld)) {
      this.lastStrips = now;
      this.areStripsOld = false;
      this.drawStrips();
    }
  }

  /** At once, for what changes seldom. */
  askForStrips() {
    this.lastStrips = 0;
    this.areStripsOld = true;
  }

  drawStrips() {
    const timelines = this.recordings.length > 0 ? this.recordings.map((recording) => recording.timeline) : [this.timeline];
    this.strips.draw({ timelines, cursor: this.player.cursor, isLive: this.player.isLive, palette: palettes[this.theme] });
    for (const pane of this.shownPanes) pane.write(this.player.isLive ? pane.timeline.end : this.player.cursor);
    this.player.showTime();
    const { ticks, missed, converged } = countTicks(this.timeline.samples, this.strips.begin, this.strips.end);
    const lost = this.timeline.latest?.lost ? ` · ${counted(this.timeline.latest.lost, 'sample')} lost` : '';
    $('counts').textContent = `${counted(ticks, 'tick')} · ${missed} missed · ${ticks ? (100 * converged / ticks).toFixed(1) : '–'} % converged${lost}`;
  }

  fileName(ending) {
    return `feeler-${this.stage?.scene ?? 'view'}.${ending}`;
  }
  async savePicture() {
    const views = this.shownPanes.map(({ view }) => view);
    document.body.classList.add('saving');
    const ends = views.map((view) => view.drawSharply());
    const picture = pngOf([document.querySelector('main'), $('strips')], palettes[this.theme].card);
    document.body.classList.remove('saving');
    for (const end of ends) end();
    download(this.fileName('png'), await picture);
  }
  saveRecording() {
    const mesh = this.recordings[0]?.mesh.buffer ?? this.meshBuffer;
    if (!mesh) return this.say('There is nothing to save yet.');
    return download(this.fileName('json'), new Blob([writeRecording(this.stage, mesh, this.timeline.frames)], { type: 'application/json' }));
  }
}

// A page in a frame without an origin, as in a report, has no storage.
function localStorageValue(key) {
  try {
    return localStorage.getItem(`feeler-${key}`);
  } catch {
    return null;
  }
}
function keepLocally(key, value) {
  try {
    localStorage.setItem(`feeler-${key}`, value);
  } catch { /* then it is asked again */ }
}

const page = new Page();
window.feeler = page;  // for tests, and for the curious
const inside = [...document.querySelectorAll('script.recording')];
try {
  if (inside.length > 0) page.replay(inside.map((script) => readRecording(script.textContent)));
  else page.goLive();
} catch (problem) {
  page.say(problem.message, true);
}
