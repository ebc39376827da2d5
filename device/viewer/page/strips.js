// Charts of every tick on one axis of time, two histograms, and a cross-hair that reads them all.
import { flags, sampleIndex } from './protocol.js';
import { degrees, withUnit } from './format.js';

const column = (name) => (ring, i) => ring.value(i, sampleIndex[name]);
const length = (x, y, z) => (ring, i) => Math.hypot(ring.value(i, sampleIndex[x]), ring.value(i, sampleIndex[y]), ring.value(i, sampleIndex[z]));

/** What is drawn over time: a title, a function of a sample, how to write a value, and the least height of the axis. */
export const strips = [
  { id: 'force', title: 'Force', of: length('fx', 'fy', 'fz'), write: (v) => withUnit(v, 'N', 1e-6), least: 0.5 },
  { id: 'torque', title: 'Torque', of: length('tx', 'ty', 'tz'), write: (v) => withUnit(v, 'N·m', 1e-9), least: 2e-3 },
  { id: 'contacts', title: 'Contacts that hold', of: column('contacts'), write: (v) => v.toFixed(0), least: 4 },
  { id: 'offset', title: 'Hand to tool', of: column('offset'), write: (v) => withUnit(v, 'm', 1e-9), least: 5e-4 },
  { id: 'turn', title: 'Turned apart', of: column('turn'), write: degrees, least: 0.02 },
  { id: 'tick', title: 'Time of a tick', of: column('compute_us'), write: (v) => `${v.toFixed(1)} µs`, least: 50 },
];
/** What is counted: of the samples that the strips show. */
export const histograms = [
  { id: 'tick-histogram', title: 'Ticks by time', of: column('compute_us') },
  { id: 'late-histogram', title: 'Lateness', of: column('late_us') },
];

/** The value of a strip at a time, in words: whoever writes one has it from here. */
export function readingAt(ring, id, time) {
  const { of, write } = strips.find((strip) => strip.id === id);
  const i = ring.from(time - 5e-4);
  return i < ring.count ? write(of(ring, i)) : '–';
}

const eventColours = { switch: '#8250df', fold: '#d6409f', budget: '#b87400' };
const decades = [0, 4];  // of a histogram: 1 µs to 10 ms
const bins = 48;

function prepared(canvas) {
  const ratio = devicePixelRatio, width = canvas.clientWidth, height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const context = canvas.getContext('2d', { willReadFrequently: true });  // in memory: a machine without a graphics processor is slow otherwise
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height };
}

function setText(node, text) {
  if (node.textContent !== text) node.textContent = text;
}

/** Least and greatest value of each pixel column; NaN where there is none. */
function envelope(ring, of, begin, end, width) {
  const low = new Float64Array(width).fill(NaN), high = new Float64Array(width).fill(NaN);
  const scale = width / (end - begin);
  for (let i = ring.from(begin); i < ring.count; ++i) {
    const x = Math.floor((ring.time(i) - begin) * scale);
    if (x >= width) break;
    const value = of(ring, i);
    if (!(low[x] <= value)) low[x] = value;
    if (!(high[x] >= value)) high[x] = value;
  }
  return { low, high };
}

/** Ticks of the samples between two times: how many, missed, converged. */
export function countTicks(ring, begin, end) {
  const counts = { ticks: 0, missed: 0, converged: 0 };
  for (let i = ring.from(begin); i < ring.count && ring.time(i) <= end; ++i) {
    ++counts.ticks;
    counts.missed += ring.value(i, sampleIndex.missed);
    counts.converged += ring.value(i, sampleIndex.flags) & flags.converged;
  }
  return counts;
}

export class Strips {
  /** @param parent  gets a figure for each strip and histogram */
  constructor(parent) {
    this.parent = parent;
    this.window = 10;  // [s]
    this.hover = null;
    this.onPick = () => {};
    this.figures = new Map([...strips, ...histograms].map((strip) => [strip.id, this.figureOf(strip)]));
    for (const { id } of strips) this.listen(this.figures.get(id).canvas);
  }

  figureOf({ id, title }) {
    const figure = document.createElement('figure');
    figure.innerHTML = `<figcaption><span>${title}</span><output></output></figcaption><canvas id="strip-${id}" role="img" aria-label="${title}"></canvas>`;
    this.parent.append(figure);
    return { canvas: figure.querySelector('canvas'), output: figure.querySelector('output') };
  }

  listen(canvas) {
    canvas.addEventListener('pointermove', (event) => {
      this.hover = event.offsetX / canvas.clientWidth;
      this.draw(this.last);
    });
    canvas.addEventListener('pointerleave', () => {
      this.hover = null;
      this.draw(this.last);
    });
    canvas.addEventListener('pointerdown', (event) => this.onPick(this.timeAt(event.offsetX / canvas.clientWidth)));
  }

  timeAt(share) {
    return this.begin + share * (this.end - this.begin);
  }

  /** @param state  { timelines, cursor, isLive, palette }: where it is live the cursor is the end */
  draw(state) {
    if (!state) return;
    this.last = state;
    const begin = Math.min(...state.timelines.map((timeline) => timeline.begin)), end = Math.max(...state.timelines.map((timeline) => timeline.end));
    this.end = state.isLive ? end : Math.min(Math.max(state.cursor + this.window / 2, begin + this.window), Math.max(end, begin + this.window));
    this.begin = this.end - this.window;
    for (const strip of strips) this.drawStrip(strip, state);
    for (const histogram of histograms) this.drawHistogram(histogram, state);
  }

  drawStrip(strip, { timelines, cursor, isLive, palette }) {
    const { canvas, output } = this.figures.get(strip.id);
    const { context, width, height } = prepared(canvas);
    const columns = Math.floor(width);
    if (columns < 2) return;
    const lines = timelines.map(({ samples }) => envelope(samples, strip.of, this.begin, this.end, columns));
    const top = Math.max(strip.least, ...lines.map(({ high }) => high.reduce((a, b) => (b > a ? b : a), 0))) * 1.08;
    const y = (v) => height - 1 - v / top * (height - 3);
    this.drawGrid(context, width, height, palette);
    this.drawEvents(context, height, timelines[0]);
    lines.forEach(({ low, high }, n) => {
      context.fillStyle = [palette.series[0], palette.other][n];
      let before = NaN;
      for (let x = 0; x < columns; ++x) {
        if (Number.isNaN(low[x])) continue;
        const from = Math.min(low[x], Number.isNaN(before) ? low[x] : before), to = Math.max(high[x], Number.isNaN(before) ? high[x] : before);
        context.fillRect(x, y(to) - 0.75, 1.25, Math.max(1.5, y(from) - y(to) + 1.5));
        before = high[x];
      }
    });
    const at = this.hover === null ? (isLive ? null : cursor) : this.timeAt(this.hover);
    if (at !== null) this.drawCursor(context, (at - this.begin) / (this.end - this.begin) * width, height, palette);
    setText(output, timelines.map(({ samples }) => readingAt(samples, strip.id, at ?? this.end)).join(' · '));
    this.writeScale(context, strip.write(top / 1.08), palette);
  }

  drawGrid(context, width, height, palette) {
    context.fillStyle = palette.grid;
    const step = this.window > 20 ? 10 : this.window > 4 ? 1 : 0.25;
    for (let t = Math.ceil(this.begin / step) * step; t < this.end; t += step) context.fillRect((t - this.begin) / this.window * width, 0, 1, height);
    context.fillRect(0, height - 1, width, 1);
  }

  /** Where the axis ends, on whatever lies there. */
  writeScale(context, text, palette) {
    context.font = '10px system-ui, "DejaVu Sans", sans-serif';
    context.lineJoin = 'round';
    context.lineWidth = 3;
    context.strokeStyle = palette.card;
    context.strokeText(text, 3, 10);
    context.fillStyle = palette.faint;
    context.fillText(text, 3, 10);
  }

  drawEvents(context, height, { events }) {
    for (const { time, kind } of events) {
      if (time < this.begin || time > this.end) continue;
      context.fillStyle = eventColours[kind];
      context.fillRect((time - this.begin) / this.window * context.canvas.clientWidth - 0.5, height - 6, 1.5, 6);
    }
  }

  drawCursor(context, x, height, palette) {
    context.fillStyle = palette.ink;
    context.fillRect(x - 0.5, 0, 1, height);
  }

  drawHistogram({ id, of }, { timelines: [{ samples }], palette }) {
    const { canvas, output } = this.figures.get(id);
    const { context, width, height } = prepared(canvas);
    const values = [], counts = new Float64Array(bins);
    for (let i = samples.from(this.begin); i < samples.count && samples.time(i) <= this.end; ++i) {
      const value = of(samples, i);
      values.push(value);
      const bin = (Math.log10(Math.max(value, 1e-3)) - decades[0]) / (decades[1] - decades[0]) * bins;
      ++counts[Math.min(Math.max(Math.floor(bin), 0), bins - 1)];
    }
    const most = Math.log1p(Math.max(1, ...counts));
    context.fillStyle = palette.series[1];
    counts.forEach((count, bin) => {
      const tall = Math.log1p(count) / most * (height - 16);
      context.fillRect(bin / bins * width, height - 13 - tall, width / bins - 1, tall);
    });
    context.fillStyle = palette.faint;
    context.font = '10px system-ui, "DejaVu Sans", sans-serif';
    ['1 µs', '10 µs', '0.1 ms', '1 ms'].forEach((text, i) => context.fillText(text, i / 4 * width + 2, height - 2));
    values.sort((a, b) => a - b);
    const quantile = (share) => values[Math.min(values.length - 1, Math.floor(share * values.length))];
    setText(output, values.length === 0 ? '–' : `p50 ${quantile(0.5).toFixed(0)} · p99 ${quantile(0.99).toFixed(0)} µs`);
  }
}
