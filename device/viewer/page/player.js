// Which moment is on show: the latest one, or one of the past that is paused, scrubbed or played.

export class Player {
  /** @param elements  pause, live, slider, clock, speed and step buttons */
  constructor(timeline, elements, isReplay) {
    this.timeline = timeline;
    this.isReplay = isReplay;
    this.isLive = !isReplay;
    this.cursor = 0;
    this.rate = 0;
    this.elements = elements;
    this.onChange = () => {};
    elements.pause.onclick = () => this.togglePause();  // instead of the player before
    elements.live.onclick = () => this.goLive();
    elements.slider.oninput = () => this.seek(Number(elements.slider.value));
    elements.back.onclick = () => this.step(-1);
    elements.forth.onclick = () => this.step(1);
    elements.speed.onchange = () => this.rate !== 0 && this.play(this.speed);
    elements.live.hidden = isReplay;
    this.update();
  }


  togglePause() {
    if (this.isLive) this.pauseAt(this.timeline.end);
    else this.play(this.rate === 0 ? this.speed : 0);
  }
  get speed() {
    return Number(this.elements.speed.value);
  }
  /** @param rate  seconds of the recording a second; negative plays backwards, 0 stops */
  play(rate) {
    this.rate = rate;
    if (rate > 0 && this.cursor >= this.timeline.end - 1e-6) this.cursor = this.timeline.begin;
    if (rate < 0 && this.cursor <= this.timeline.begin + 1e-6) this.cursor = this.timeline.end;
    this.lastStep = performance.now();
    this.update();
  }
  pauseAt(time) {
    this.isLive = false;
    this.rate = 0;
    this.cursor = time;
    this.update();
  }
  seek(time) {
    this.isLive = false;
    this.cursor = Math.min(Math.max(time, this.timeline.begin), this.timeline.end);
    this.update();
  }
  step(frames) {
    const { length } = this.timeline.frames, now = this.isLive ? length - 1 : this.timeline.frameIndexAt(this.cursor);
    const index = Math.min(Math.max(now + frames, 0), length - 1);
    if (index >= 0) this.pauseAt(this.timeline.frames[index].time);
  }
  goLive() {
    if (this.isReplay) return;
    this.isLive = true;
    this.rate = 0;
    this.update();
  }

  /** Once a picture. @return whether the moment has changed */
  advance() {
    if (this.isLive || this.rate === 0) return false;
    const now = performance.now();
    this.cursor += this.rate * (now - this.lastStep) / 1000;
    this.lastStep = now;
    if (this.cursor >= this.timeline.end || this.cursor <= this.timeline.begin) {
      this.cursor = Math.min(Math.max(this.cursor, this.timeline.begin), this.timeline.end);
      this.rate = 0;
    }
    this.update();
    return true;
  }

  update() {
    const { pause, live, slider, clock } = this.elements;
    const isMoving = this.isLive || this.rate !== 0;
    pause.textContent = isMoving ? 'Pause' : 'Play';
    pause.setAttribute('aria-pressed', String(!isMoving));
    live.disabled = this.isLive;
    this.showTime(slider, clock);
    this.onChange();
  }

  showTime(slider = this.elements.slider, clock = this.elements.clock) {
    slider.min = this.timeline.begin;
    slider.max = this.timeline.end;
    slider.value = this.isLive ? this.timeline.end : this.cursor;
    clock.textContent = this.isLive ? 'live' : `${this.cursor.toFixed(3)} s`;
  }
}
