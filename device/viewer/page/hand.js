// The mouse or a finger as the hand: drags the red tool in the plane of the picture, towards the eye, and about axes.
import { Quaternion, Raycaster, Vector2, Vector3 } from 'three';

const grabRadius = 46;    // around the tool's middle or its tip [px], where no ray hits it
const turnPerPixel = 0.008;
const depthPerNotch = 0.03;  // of the tool's size

/** The pose that the user holds, and how input moves it; all devices of input share it. */
export class HeldPose {
  constructor(view, source) {
    this.view = view;
    this.source = source;
    this.pose = null;
    this.isElsewhere = false;  // the hand is at a real device: here it only can be looked at
  }

  get isHeld() {
    return this.pose !== null;
  }
  /** From where the tool of the hand is now. */
  grab() {
    if (this.pose || !this.view.frame || this.isElsewhere) return;
    const { position, quaternion } = this.view.frame.haptic;
    this.pose = { position: new Vector3(...position), quaternion: new Quaternion().fromArray(quaternion) };
  }
  release() {
    this.pose = null;
  }

  /** By a way in axes of the camera: right, up, to the eye [m]. */
  move(right, up, near) {
    this.grab();
    if (!this.pose) return;
    this.pose.position.add(new Vector3(right, up, near).applyQuaternion(this.view.camera.quaternion));
    this.send();
  }
  /** By a rotation vector in axes of the camera [rad]. */
  turn(x, y, z) {
    this.grab();
    if (!this.pose) return;
    const axis = new Vector3(x, y, z).applyQuaternion(this.view.camera.quaternion);
    const angle = axis.length();
    if (angle > 0) this.pose.quaternion.premultiply(new Quaternion().setFromAxisAngle(axis.divideScalar(angle), angle)).normalize();
    this.send();
  }
  send() {
    this.source.moveHand({ position: this.pose.position.toArray(), quaternion: this.pose.quaternion.toArray() });
  }

  /** Metres of the scene a pixel at the tool. */
  get scale() {
    const distance = this.view.camera.position.distanceTo(this.view.haptic.position);
    return 2 * distance * Math.tan(this.view.camera.fov * Math.PI / 360) / this.view.canvas.clientHeight;
  }
}

/** Pointers on the canvas: on the red tool they drag it, elsewhere they are the camera's. */
export class PointerHand {
  constructor(held) {
    this.held = held;
    this.view = held.view;
    this.canvas = held.view.canvas;
    this.pointers = new Map();
    this.turns = false;  // what one finger does, where there is no second button
    this.canvas.addEventListener('pointerdown', (event) => this.down(event), { capture: true });
    this.canvas.addEventListener('pointermove', (event) => this.moved(event));
    for (const end of ['pointerup', 'pointercancel']) this.canvas.addEventListener(end, (event) => this.up(event));
    this.canvas.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    this.canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  }

  isOnTool({ clientX, clientY }) {
    if (this.held.isElsewhere) return false;
    const box = this.canvas.getBoundingClientRect();
    const at = new Vector2((clientX - box.left) / box.width * 2 - 1, 1 - (clientY - box.top) / box.height * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.view.camera);
    const { haptic, graphic } = this.view;
    if (ray.intersectObjects([haptic.surface, graphic.surface], false).length > 0) return true;
    const tip = this.view.stage ? haptic.localToWorld(new Vector3(...this.view.stage.tip)) : haptic.position;
    return [haptic.position, tip].some((point) => {
      const seen = point.clone().project(this.view.camera);
      return Math.hypot((seen.x - at.x) * box.width, (seen.y - at.y) * box.height) / 2 < grabRadius;
    });
  }

  down(event) {
    if (this.pointers.size === 0 && !this.isOnTool(event)) return;
    event.stopImmediatePropagation();
    event.preventDefault();
    this.canvas.focus();
    this.canvas.setPointerCapture(event.pointerId);
    this.pointers.set(event.pointerId, { x: event.clientX, y: event.clientY });
    this.canvas.classList.add('dragging');
    this.held.grab();
  }

  moved(event) {
    const last = this.pointers.get(event.pointerId);
    if (!last) {
      if (event.pointerType === 'mouse' && event.buttons === 0) this.canvas.classList.toggle('on-tool', this.view.frame != null && this.isOnTool(event));
      return;
    }
    const dx = event.clientX - last.x, dy = event.clientY - last.y;
    const before = this.pair();
    Object.assign(last, { x: event.clientX, y: event.clientY });
    if (before) return this.moveByTwo(before, this.pair());
    const turns = this.turns !== (event.shiftKey || (event.buttons & 2) !== 0);
    if (turns) this.held.turn(dy * turnPerPixel, dx * turnPerPixel, 0);
    else this.held.move(dx * this.held.scale, -dy * this.held.scale, 0);
    return undefined;
  }

  /** Of two fingers: their middle, distance and angle; null of one. */
  pair() {
    if (this.pointers.size < 2) return null;
    const [a, b] = [...this.pointers.values()];
    return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2, distance: Math.hypot(b.x - a.x, b.y - a.y), angle: Math.atan2(b.y - a.y, b.x - a.x) };
  }
  /** Two fingers: sideways turns, a twist rolls, a spread brings nearer. */
  moveByTwo(before, after) {
    this.held.turn((after.y - before.y) * turnPerPixel, (after.x - before.x) * turnPerPixel, before.angle - after.angle);
    this.held.move(0, 0, (after.distance - before.distance) * this.held.scale);
  }

  up(event) {
    if (!this.pointers.delete(event.pointerId)) return;
    if (this.pointers.size > 0) return;
    this.canvas.classList.remove('dragging');
    this.held.release();
  }

  wheel(event) {
    const isDragging = this.pointers.size > 0;
    if (!isDragging && !event.shiftKey) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    const notches = -Math.sign(event.deltaY || event.deltaX);
    if (event.shiftKey && !isDragging) this.held.turn(0, 0, 0.05 * notches);
    else this.held.move(0, 0, notches * depthPerNotch * this.view.size);
    if (!isDragging) this.held.release();
  }
}
