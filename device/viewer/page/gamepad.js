// A game controller as the hand: the left stick moves the tool, the right one turns it, the triggers push and pull.

const deadZone = 0.12, sizesASecond = 0.9, turnsASecond = 1.6;

const beyondDeadZone = (v) => (Math.abs(v) < deadZone ? 0 : Math.sign(v) * (Math.abs(v) - deadZone) / (1 - deadZone));

/** What the sticks ask for: a way and a turn, each from −1 to 1 an axis. */
export function readSticks({ axes, buttons }) {
  const [x, y, rx, ry] = [0, 1, 2, 3].map((i) => beyondDeadZone(axes[i] ?? 0));
  const pressed = (i) => buttons[i]?.value ?? 0;
  return { way: [x, -y, pressed(7) - pressed(6)], turn: [ry, rx, pressed(4) - pressed(5)] };
}

export class GamepadHand {
  constructor(held) {
    this.held = held;
    this.isMoving = false;
    addEventListener('gamepadconnected', () => this.watch());
  }

  watch() {
    if (this.isWatching) return;
    this.isWatching = true;
    this.last = performance.now();
    const step = () => {
      const pad = [...navigator.getGamepads()].find((p) => p);
      if (!pad) return (this.isWatching = false);
      this.step(readSticks(pad));
      return requestAnimationFrame(step);
    };
    requestAnimationFrame(step);
  }

  step({ way, turn }) {
    const now = performance.now(), seconds = Math.min((now - this.last) / 1000, 0.1);
    this.last = now;
    const isAsked = [...way, ...turn].some((v) => v !== 0);
    if (!isAsked) {
      if (this.isMoving) this.held.release();
      this.isMoving = false;
      return;
    }
    this.isMoving = true;
    this.held.move(...way.map((v) => v * sizesASecond * seconds * this.held.view.size));
    this.held.turn(...turn.map((v) => v * turnsASecond * seconds));
  }
}
