// The keyboard as the hand: keys move the tool while they are held, and with Shift they turn it.

const moves = {
  KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyW: [0, 1, 0], KeyS: [0, -1, 0], KeyE: [0, 0, 1], KeyQ: [0, 0, -1],
  ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0], PageUp: [0, 0, 1], PageDown: [0, 0, -1],
};
const sizesASecond = 0.9, fineShare = 0.12, turnsASecond = 1.4;

/** Keys of the picture; it must have the focus, so that forms keep theirs. */
export class KeyboardHand {
  constructor(held, canvas) {
    this.held = held;
    this.keys = new Set();
    canvas.addEventListener('keydown', (event) => this.down(event));
    canvas.addEventListener('keyup', (event) => this.keys.delete(event.code));
    canvas.addEventListener('blur', () => this.stop());
  }

  down(event) {
    if (!(event.code in moves) || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    this.shift = event.shiftKey;
    this.alt = event.altKey;
    const isFirst = this.keys.size === 0;
    this.keys.add(event.code);
    if (!isFirst) return;
    this.held.grab();
    this.last = performance.now();
    requestAnimationFrame(() => this.step());
  }

  stop() {
    this.keys.clear();
  }

  step() {
    if (this.keys.size === 0) return this.held.release();
    const now = performance.now(), seconds = Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const sum = [0, 0, 0];
    for (const key of this.keys) moves[key].forEach((v, i) => (sum[i] += v));
    const pace = seconds * (this.alt ? fineShare : 1);
    if (this.shift) this.held.turn(-sum[1] * turnsASecond * pace, sum[0] * turnsASecond * pace, -sum[2] * turnsASecond * pace);
    else this.held.move(...sum.map((v) => v * sizesASecond * pace * this.held.view.size));
    requestAnimationFrame(() => this.step());
    return undefined;
  }
}
