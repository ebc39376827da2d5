// What happened: every sample of the last minute and every frame, by time. A live view fills it as it goes, a replay at once.
import { sampleIndex, sampleWords } from './protocol.js';

/** First index of 0 … count − 1 whose key is not below a value; count if there is none. */
function lowerBound(count, keyOf, value) {
  let low = 0, high = count;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (keyOf(middle) < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** A ring of samples; index 0 is the oldest one kept. */
export class SampleRing {
  constructor(capacity) {
    this.capacity = capacity;
    this.words = new Float64Array(capacity * sampleWords);
    this.begin = 0;
    this.count = 0;
  }

  push(words) {
    for (let at = 0; at < words.length; at += sampleWords) {
      const slot = (this.begin + this.count) % this.capacity;
      this.words.set(words.subarray(at, at + sampleWords), slot * sampleWords);
      if (this.count < this.capacity) ++this.count;
      else this.begin = (this.begin + 1) % this.capacity;
    }
  }

  value(i, column) {
    return this.words[((this.begin + i) % this.capacity) * sampleWords + column];
  }
  time(i) {
    return this.value(i, sampleIndex.time);
  }
  /** Index of the first sample at a time or later. */
  from(time) {
    return lowerBound(this.count, (i) => this.time(i), time);
  }
}

/** Samples, frames and events of a run. */
export class Timeline {
  static keptSeconds = 60;

  constructor(sampleCapacity = 1) {
    this.samples = new SampleRing(sampleCapacity);
    this.frames = [];
    this.events = [];
    this.isGrowing = false;  // of a live view
  }

  /** @param keepsAll  of a replay: nothing grows old */
  add(frame, keepsAll = false) {
    this.samples.push(frame.samples);
    this.frames.push(frame);
    const oldest = frame.time - Timeline.keptSeconds;
    if (keepsAll) return;
    if (this.frames[0].time < oldest - 5) this.frames.splice(0, lowerBound(this.frames.length, (i) => this.frames[i].time, oldest));
    while (this.events.length > 0 && this.events[0].time < oldest) this.events.shift();
  }
  addEvent(time, kind) {
    this.events.push({ time, kind });
  }

  /** @param rate  of the samples to come [1/s] */
  restart(rate) {
    this.samples = new SampleRing(Math.ceil(rate * (Timeline.keptSeconds + 5)));
    this.frames.length = this.events.length = 0;
    this.isGrowing = true;
  }

  get begin() {
    return this.samples.count > 0 ? this.samples.time(0) : 0;
  }
  get end() {
    return this.samples.count > 0 ? this.samples.time(this.samples.count - 1) : 0;
  }
  get latest() {
    return this.frames.at(-1);
  }

  /** Index of the last frame at a time or before; 0 where all are later, −1 where there is none. */
  frameIndexAt(time) {
    const after = lowerBound(this.frames.length, (i) => this.frames[i].time, time + 1e-9);
    return this.frames.length === 0 ? -1 : Math.max(0, after - 1);
  }
  frameAt(time) {
    return this.frames[this.frameIndexAt(time)];
  }
}
