// The way of the tool's tip, of the last frames shown.
import { Group, Vector3 } from 'three';
import { FatLine, fatMaterial } from './fat_line.js';
import { tipOf } from './pose.js';

export const traceSeconds = 4;
const slowPeriod = 0.1;  // between changes where a change is slow [s]: the tool hides the rest

export class Trace extends Group {
  /** @param isSlow  whether this machine draws without a graphics processor, to which lines that change are dear */
  constructor(isSlow) {
    super();
    this.period = isSlow ? slowPeriod : 0;
    this.drawn = { time: NaN, stage: 0 };
    this.graphicMaterial = fatMaterial('#000', 2.5);
    this.hapticMaterial = fatMaterial('#000', 1.5);
    this.graphic = new FatLine(this.graphicMaterial);
    this.haptic = new FatLine(this.hapticMaterial);
    this.add(this.graphic, this.haptic);
  }

  /** Whether what is drawn will do for a frame. */
  isFresh({ time, stage }) {
    return stage === this.drawn.stage && time >= this.drawn.time && time < this.drawn.time + this.period;
  }

  /** @param index  of the frame on show in the timeline's list */
  show(frames, index, tip, stage) {
    if (!this.visible || index < 0 || this.isFresh(frames[index])) return;
    this.drawn = frames[index];
    const points = { graphic: [], haptic: [] };
    const local = new Vector3(...tip);
    for (let i = index; i >= 0 && frames[i].time > frames[index].time - traceSeconds && frames[i].stage === stage; i -= 2) {
      points.graphic.push(...tipOf(frames[i].graphic, local).toArray());
      points.haptic.push(...tipOf(frames[i].haptic, local).toArray());
    }
    this.graphic.setPoints(points.graphic);
    this.haptic.setPoints(points.haptic);
  }
}
