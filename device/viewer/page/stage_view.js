// The picture of one stage: object, both tools, the spring between them, contacts, wrench and trace.
import { Color, Group, PerspectiveCamera, Scene, Vector3, WebGLRenderer } from 'three';
import { OrbitControls } from 'three/addons/controls/OrbitControls.js';
import { Arrow } from './arrow.js';
import { CloseUp } from './close_up.js';
import { ContactsView } from './contacts_view.js';
import { Backdrop } from './backdrop.js';
import { FatLine, fatMaterial, setLineColour } from './fat_line.js';
import { norm } from './format.js';
import { ObjectView } from './object_view.js';
import { palettes } from './palette.js';
import { place, tipOf } from './pose.js';
import { ToolView } from './tool_view.js';
import { Trace } from './trace.js';

const fullForce = 5, fullTorque = 0.06;  // [N], [N·m]: as long as the tool is large
const longestArrow = 0.6;               // of the tool's size, beyond which an arrow says no more
const slowFrame = 30, fastFrame = 18;    // between two drawn one after the other [ms], at which fewer or more pixels are drawn
const leastPixels = 0.6;
const fewTriangles = 3000;               // of an object that is drawn anew each time
const pixelsAtRest = 2, mostTrianglesAtRest = 3e5;  // of a picture that stays: smooth edges where no motion pays for them
const longPause = 300;                   // after which a picture has not waited for the one before [ms]

/** Whether this machine draws without a graphics processor: then smooth edges cost more than they show. */
function drawsInSoftware() {
  const context = document.createElement('canvas').getContext('webgl2');
  const names = context?.getExtension('WEBGL_debug_renderer_info');
  const name = names ? context.getParameter(names.UNMASKED_RENDERER_WEBGL) : '';
  context?.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|software/i.test(name);
}

/** A zigzag from one point to another, as a spring is drawn. */
function springPoints(from, to, width) {
  const along = to.clone().sub(from);
  const length = along.length();
  if (length < 1e-7) return [];
  const side = new Vector3(0, 0, 1).cross(along);
  if (side.lengthSq() < 1e-14) side.set(1, 0, 0);
  side.setLength(Math.min(width, 0.35 * length));
  const points = [...from.toArray()], turns = 12;
  for (let i = 1; i < turns; ++i) {
    const bend = i < 2 || i > turns - 2 ? 0 : i % 2 === 0 ? 1 : -1;
    points.push(...from.clone().addScaledVector(along, i / turns).addScaledVector(side, bend).toArray());
  }
  return [...points, ...to.toArray()];
}

export class StageView {
  /** @param elements  canvas, labels, closeUp, closeUpCaption and scaleBar */
  constructor(elements) {
    this.canvas = elements.canvas;
    const isSlow = this.isSlow = drawsInSoftware();
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !isSlow, alpha: isSlow });
    this.renderer.autoClear = false;
    this.mostPixels = Math.min(devicePixelRatio, isSlow ? 1 : 2);
    this.pixels = this.mostPixels;
    this.lastDrawn = 0;
    this.backdrop = isSlow ? new Backdrop(this.canvas) : null;
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(35, 1, 0.001, 10);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.enableDamping = false;
    this.controls.addEventListener('change', () => this.changed());
    this.object = new ObjectView();
    this.haptic = new ToolView({ opacity: 0.32, lineWidth: 2, renderOrder: 4 });
    this.graphic = new ToolView({ opacity: 1, lineWidth: 1.6, renderOrder: 2 });
    this.springMaterial = fatMaterial('#000', 2.5, { isOnTop: true });
    this.spring = new FatLine(this.springMaterial);
    this.spring.renderOrder = 7;
    this.force = new Arrow('#000');
    this.torque = new Arrow('#000', { turns: true });
    this.contacts = new ContactsView(elements.labels);
    this.trace = new Trace(isSlow);
    this.arrows = new Group().add(this.force, this.torque);
    this.marks = new Group().add(this.spring, this.arrows, this.contacts, this.trace);
    this.scene.add(this.object, this.graphic, this.haptic, this.marks);
    this.closeUp = new CloseUp(elements.closeUp, elements.closeUpCaption, elements.scaleBar);
    this.follows = false;
    this.magnifies = false;
    this.frameTimes = [];
    this.framesDrawn = 0;
    this.isAtRest = false;
    this.firstPicture = null;  // when there was one of object and tool, since the page was asked for [ms]
    new ResizeObserver(() => this.resize()).observe(this.canvas.parentElement);
    this.setTheme('light');
  }

  /** Called when something is to be drawn anew; the page sets it. */
  changed() {}

  setStage(stage) {
    this.stage = stage;
    this.frame = this.mesh = null;
    this.closeUp.reset();
    this.haptic.setPieces(stage.tool);
    this.graphic.setPieces(stage.tool);
    this.size = 2 * this.graphic.radius;
    this.contacts.size = this.size;
    place(this.haptic, { position: stage.start.position, quaternion: [...stage.start.orientation.slice(1), stage.start.orientation[0]] });
    place(this.graphic, { position: stage.start.position, quaternion: this.haptic.quaternion.toArray() });
  }

  setMesh(mesh) {
    this.mesh = mesh;
    this.object.setMesh(mesh);
    this.resetCamera();
    this.changed();
  }

  /** Looks at the tool and as much of the object as leaves the tool large enough to see. */
  resetCamera() {
    const tool = this.graphic.position, object = this.object.position;
    const reach = this.object.radius ?? this.size;
    const isWhole = reach < 3 * this.size;
    const apart = isWhole ? tool.distanceTo(object) : 0;
    const objectRadius = isWhole ? reach : 1.7 * this.size, toolRadius = this.graphic.radius;
    const radius = Math.max(objectRadius, toolRadius, (apart + objectRadius + toolRadius) / 2);
    const share = Math.min((radius - objectRadius) / Math.max(apart, 1e-9), 1);
    const middle = object.clone().lerp(tool, isWhole ? share : 0.55);
    const distance = 1.05 * radius / Math.sin(this.camera.fov * Math.PI / 360);
    this.controls.target.copy(middle);
    this.camera.position.copy(middle).add(new Vector3(0.45, -0.8, 0.52).setLength(distance));
    this.camera.near = distance / 100;
    this.camera.far = distance * 10 + 10 * reach;
    this.camera.updateProjectionMatrix();
    this.controls.minDistance = this.size / 20;
    this.controls.maxDistance = 20 * reach;
    this.controls.update();
  }

  setTheme(name) {
    this.theme = name;
    const palette = this.palette = palettes[name];
    this.scene.background = new Color(palette.background);
    this.object.setColours(palette);
    this.haptic.setColours(palette.haptic, palette.haptic);
    this.graphic.setColours(palette.graphic, palette.graphicEdge);
    setLineColour(this.springMaterial, palette.spring);
    this.force.material.color.set(palette.force);
    this.torque.material.color.set(palette.torque);
    setLineColour(this.trace.graphicMaterial, palette.trace);
    setLineColour(this.trace.hapticMaterial, palette.hapticTrace);
    this.changed();
  }

  showFrame(frame, frames, index) {
    if (!this.stage || frame.stage !== this.stage.stage) return;
    if (this.follows && this.frame) this.shiftCamera(this.frame.graphic.position, frame.graphic.position);
    this.frame = frame;
    place(this.haptic, frame.haptic);
    place(this.graphic, frame.graphic);
    this.spring.setPoints(springPoints(tipOf(frame.haptic, this.tip()), tipOf(frame.graphic, this.tip()), 0.05 * this.size));
    this.showWrench(frame);
    this.contacts.show(frame.contacts);
    this.trace.show(frames, index, this.stage.tip, this.stage.stage);
    this.changed();
  }

  tip() {
    return new Vector3(...this.stage.tip);
  }

  showWrench({ graphic, force, torque }) {
    const from = new Vector3(...graphic.position), thickness = 0.012 * this.size;
    for (const [arrow, vector, full] of [[this.force, force, fullForce], [this.torque, torque, fullTorque]]) {
      const size = norm(vector);
      if (size === 0) arrow.visible = false;
      else arrow.set(from, new Vector3(...vector).divideScalar(size), this.size * Math.min(size / full, longestArrow), thickness);
    }
  }

  shiftCamera(from, to) {
    const shift = new Vector3(...to).sub(new Vector3(...from));
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
  }

  resize() {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.isAtRest = false;
    this.renderer.setPixelRatio(this.pixels);
    this.renderer.setSize(clientWidth, clientHeight, false);
    this.camera.aspect = clientWidth / clientHeight;
    // Off the middle, because the words are at the upper left.
    this.camera.setViewOffset(clientWidth, clientHeight, -0.05 * clientWidth, -0.035 * clientHeight, clientWidth, clientHeight);
    this.changed();
  }

  draw() {
    if (this.isAtRest) this.renderer.setPixelRatio(this.pixels);
    this.isAtRest = false;
    this.render();
    this.adapt();
  }

  /** Once more, when nothing has moved for a while: with smooth edges where moving pictures have none. */
  drawAtRest() {
    if (this.isAtRest || !this.isSlow || !this.mesh || this.object.triangleCount > mostTrianglesAtRest) return;
    this.isAtRest = true;
    this.renderer.setPixelRatio(pixelsAtRest);
    this.render(true);
  }

  /** As sharp as the screen is, whatever it costs, with all of it in the canvas. @return what goes back to moving pictures */
  drawSharply() {
    const { pixels } = this;
    this.pixels = devicePixelRatio;
    this.resize();
    this.render(true);
    return () => {
      this.pixels = pixels;
      this.resize();
    };
  }

  /** @param isWhole  whether all of it is to be in the canvas, as it must be to be saved */
  render(isWhole = false) {
    const { clientWidth, clientHeight } = this.canvas.parentElement;
    this.renderer.setViewport(0, 0, clientWidth, clientHeight);
    this.camera.updateMatrixWorld();
    if (isWhole || !this.drawsOverBackdrop()) {
      this.renderer.clear();
      this.renderer.render(this.scene, this.camera);
    }
    this.contacts.placeLabels(this.camera, clientWidth, clientHeight, this.closeUp.box);
    if (this.magnifies && this.frame) this.drawCloseUp();
    ++this.framesDrawn;
    if (this.mesh && this.frame) this.firstPicture ??= performance.now();
  }

  /** @return whether it has drawn: not where the object or the eye has just moved */
  drawsOverBackdrop() {
    const { backdrop, object, renderer, scene, camera } = this, { background } = scene;
    if (!backdrop || object.look !== 'solid' || !(object.triangleCount > fewTriangles)) return false;
    const draw = (...parts) => {
      for (const part of scene.children) part.visible = parts.includes(part);
      scene.background = parts.includes(object) ? background : null;
      renderer.render(scene, camera);
    };
    const holds = backdrop.holds(renderer, camera, `${this.stage.stage} ${this.theme} ${object.cut.toArray()}`, () => draw(object));
    if (holds) {
      backdrop.draw(renderer, (cells) => {
        for (const tool of [this.haptic, this.graphic]) cells.addSphere(camera, tool.position, tool.radius);
        if (this.trace.visible) for (const line of this.trace.children) cells.addLine(camera, line.points);
      });
      draw(this.graphic, this.haptic, this.marks);
    }
    for (const part of scene.children) part.visible = true;
    scene.background = background;
    return holds;
  }

  drawCloseUp() {
    this.closeUp.aim(this.frame, tipOf(this.frame.graphic, this.graphic.middle), this.camera);
    this.closeUp.draw(this.mesh, this.stage.tool, this.frame.graphic, this.palette);
  }

  /** Fewer pixels where the machine draws them slowly. */
  adapt() {
    const now = performance.now(), interval = now - this.lastDrawn;
    this.lastDrawn = now;
    if (interval > longPause) return;
    this.frameTimes.push(interval);
    if (this.frameTimes.length < 16) return;
    const median = this.frameTimes.sort((a, b) => a - b)[8];
    this.frameTimes = [];
    const wanted = median > slowFrame ? this.pixels * 0.8 : median < fastFrame ? this.pixels * 1.1 : this.pixels;
    const pixels = Math.min(Math.max(wanted, leastPixels), this.mostPixels);
    if (Math.abs(pixels - this.pixels) < 0.02) return;
    this.pixels = pixels;
    this.resize();
  }
}
