// The clearance view: a cut through the tightest place, magnified until the gap can be seen.
import { Vector3 } from 'three';
import { clipped, clippedSegment, cutMesh, cutPiece, cuttingPlane, enclose, gapBetween, leastGap, loopsOf } from './cross_section.js';
import { withUnit } from './format.js';

const autoFields = { least: 8e-6, gaps: 12 };  // of a picture's height: [m], and in gaps
const faithful = 2;  // times the least gap, up to which the place that is on show stays on show
const margin = 2;    // fields around the middle, beyond which nothing is drawn
const skin = 0.22;   // of the field: how deep a surface is drawn that encloses nothing

const distance = (a, b) => Math.hypot(...a.map((v, k) => v - b[k]));

/** The contact with the least gap that a frame has; one near a place if it is about as tight. */
export function tightest(frame, place = null) {
  const all = frame.holding.length > 0 ? frame.holding : frame.contacts;  // the place of a recognised area is amid what touches, and may be in the air
  if (all.length === 0) return null;
  const best = all.reduce((a, b) => (b.gap < a.gap ? b : a));
  if (!place) return best;
  const tight = all.filter(({ gap }) => gap <= faithful * Math.abs(best.gap) + 1e-8);
  return tight.reduce((a, b) => (distance(b.point, place.point) < distance(a.point, place.point) ? b : a));
}

export class CloseUp {
  /** @param box  an element with a canvas, a caption for the gap and the magnification, and a scale */
  constructor(box, caption, scaleBar) {
    this.box = box;
    this.canvas = box.querySelector('canvas');
    this.caption = caption;
    this.scaleBar = scaleBar;
    this.field = null;  // height of what is shown [m]; null for what suits the gap
    this.place = null;
  }

  /** Another scene: nothing is aimed at. */
  reset() {
    this.place = null;
  }

  /** Aims at the tightest contact of a frame, or stays at the last one. @param middle  of the tool, which the cut goes through too */
  aim(frame, middle, camera) {
    const contact = tightest(frame, this.place);
    if (contact) {
      const up = new Vector3(...contact.normal), toEye = new Vector3().setFromMatrixColumn(camera.matrixWorld, 2);
      const right = middle.clone().sub(new Vector3(...contact.point)).projectOnPlane(up);
      if (right.lengthSq() < 1e-10) right.copy(up).cross(toEye);
      if (right.lengthSq() < 1e-10) right.setFromMatrixColumn(camera.matrixWorld, 0).projectOnPlane(up);
      if (right.clone().cross(up).dot(toEye) < 0) right.negate();  // as it is seen from the eye
      this.place = { point: contact.point, up: up.toArray(), right: right.normalize().toArray(), gap: contact.gap };
    } else if (this.place) {
      this.place = { ...this.place, gap: null };
    }
  }

  height() {
    return this.field ?? Math.max(autoFields.least, autoFields.gaps * Math.abs(this.place?.gap ?? 1e-6));
  }

  /** @param pieces  of the tool  @param pose  of the graphic tool */
  draw(mesh, pieces, pose, palette) {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0) return;
    const ratio = devicePixelRatio, size = [Math.round(width * ratio), Math.round(height * ratio)];
    if (this.canvas.width !== size[0] || this.canvas.height !== size[1]) [this.canvas.width, this.canvas.height] = size;
    const context = this.canvas.getContext('2d', { willReadFrequently: true });
    context.setTransform(1, 0, 0, 1, 0, 0);
    context.fillStyle = palette.background;
    context.fillRect(0, 0, ...size);
    this.caption.textContent = this.describe(height);
    if (!this.place || !mesh) return;
    const field = this.height(), scale = size[1] / field, reach = margin * field * Math.max(1, width / height);
    const { point, right, up, gap } = this.place;
    const cut = (origin) => {
      const plane = cuttingPlane(origin, right, up);
      return { walls: cutMesh(mesh, plane), tools: pieces.map((piece) => cutPiece(piece, pose, plane, field)) };
    };
    const first = cut(point), nearest = gapBetween(first.walls, first.tools, field);
    // The middle of the picture is at the wall: the place of a contact is at either, and a linearisation away.
    const { walls, tools } = nearest ? cut(point.map((v, k) => v + nearest.u * right[k] + nearest.wall * up[k])) : first;
    const wide = nearest ? nearest.tool - nearest.wall : gap ?? 0;
    const toPixels = ([u, v]) => [size[0] / 2 + u * scale, size[1] / 2 - v * scale];
    const pen = { context, ratio, field, reach, palette, toPixels };
    drawObject(pen, walls, { free: [0, Math.max(wide, leastGap) / 2], isRight: nearest?.isRight });
    for (const polygon of tools) drawPiece(pen, polygon);
    if (nearest && gap !== null) drawGap(pen, wide);
    this.drawScale(field, height);
  }

  describe(height) {
    if (!this.place) return 'Touch a wall to see the gap.';
    const gap = this.place.gap === null ? 'no contact now' : `gap ${withUnit(this.place.gap, 'm', 1e-10)}`;
    const magnification = height * 0.000264 / this.height();  // a CSS pixel is 1/96 inch
    return `${gap} · × ${Number(magnification.toPrecision(2)).toLocaleString('en')}`;
  }

  drawScale(field, height) {
    const longest = 0.45 * field, decade = 10 ** Math.floor(Math.log10(longest));
    const length = decade * [5, 2, 1].find((step) => step * decade <= longest);
    this.scaleBar.style.width = `${length / field * height}px`;
    this.scaleBar.textContent = withUnit(length, 'm', 1e-10);
  }
}

function trace({ context, toPixels }, polygon, closes = true) {
  polygon.forEach((p, i) => (i === 0 ? context.moveTo(...toPixels(p)) : context.lineTo(...toPixels(p))));
  if (closes) context.closePath();
}

/**
 * The side of a closed surface on which the tool is not, or a skin on the far side of an open one.
 * @param free     a point between wall and tool
 * @param isRight  whether the far side is at the right of segments; undefined where there is no wall below the tool
 */
function drawObject(pen, segments, { free, isRight }) {
  const { context, ratio, field, reach, palette } = pen;
  const lines = segments.map(({ from, to }) => clippedSegment(from, to, reach)).filter((line) => line);
  const loops = loopsOf(segments);
  context.fillStyle = palette.object;
  context.beginPath();
  if (loops) {
    for (const loop of loops) trace(pen, clipped(loop, reach));
    if (enclose(loops, free)) trace(pen, [[-reach, -reach], [reach, -reach], [reach, reach], [-reach, reach]]);
    context.fill('evenodd');
  } else {
    for (const part of skinParts(segments, reach, skin * field, isRight)) trace(pen, part);
    context.fill('nonzero');
  }
  context.beginPath();
  for (const line of lines) trace(pen, line, false);
  context.strokeStyle = palette.edges;
  context.lineWidth = 1.5 * ratio;
  context.lineCap = 'round';
  context.stroke();
}

/** Strips along the far side of segments: where two meet they are cut off at each other, or a wedge is between them. */
function skinParts(segments, reach, depth, isRight) {
  const strips = [], corners = new Map();
  for (const { from, to, ends } of segments) {
    const line = clippedSegment(from, to, reach);
    if (!line) continue;
    const way = [to[0] - from[0], to[1] - from[1]], length = Math.hypot(...way) || 1;
    const side = (isRight ?? way[0] >= 0) ? -1 / length : 1 / length;  // by itself downwards
    const far = [-way[1] * side, way[0] * side];  // a unit to the far side
    const strip = { points: [from, to], far, part: [...line, ...line.toReversed().map((p) => [p[0] + depth * far[0], p[1] + depth * far[1]])] };
    strips.push(strip);
    ends.forEach((end, i) => corners.set(end, [...(corners.get(end) ?? []), { strip, at: i }]));
  }
  const wedges = [];
  for (const met of corners.values()) {
    if (met.length !== 2) continue;
    const [a, b] = met, p = a.strip.points[a.at];
    const beyond = (one, other) => other.strip.points[1 - other.at].reduce((sum, v, k) => sum + (v - p[k]) * one.strip.far[k], 0);
    if (beyond(a, b) > 0) {
      const [cutA, cutB] = [cutOff(a.strip.part, p, b.strip.far), cutOff(b.strip.part, p, a.strip.far)];
      [a.strip.part, b.strip.part] = [cutA, cutB];
    } else {
      wedges.push([p, ...[a, b].map(({ strip: { far } }) => [p[0] + depth * far[0], p[1] + depth * far[1]])]);
    }
  }
  return [...strips.map(({ part }) => part), ...wedges].map((part) => (turnsLeft(part) ? part : part.reverse()));  // so that none is cut out of another
}

/** The part of a polygon on one side of a line. @param side  a normal towards it */
function cutOff(polygon, [u, v], side) {
  const height = (p) => (p[0] - u) * side[0] + (p[1] - v) * side[1];
  return polygon.flatMap((p, i) => {
    const q = polygon[(i + 1) % polygon.length], [a, b] = [height(p), height(q)];
    const crossing = a >= 0 !== b >= 0 ? [p.map((x, k) => x + a / (a - b) * (q[k] - x))] : [];
    return a >= 0 ? [p, ...crossing] : crossing;
  });
}

function turnsLeft(polygon) {
  return polygon.reduce((sum, [u, v], i) => sum + u * polygon[(i + 1) % polygon.length][1] - v * polygon[(i + 1) % polygon.length][0], 0) > 0;
}

function drawPiece(pen, polygon) {
  const { context, ratio, reach, palette, toPixels } = pen;
  context.fillStyle = palette.graphic;
  context.strokeStyle = palette.graphicEdge;
  context.lineWidth = 1.5 * ratio;
  context.beginPath();
  if (polygon.length === 1) {
    context.arc(...toPixels(polygon[0]), 3 * ratio, 0, 2 * Math.PI);
  } else {
    const part = polygon.length === 2 ? clippedSegment(...polygon, reach) : clipped(polygon, reach);
    if (!part) return;
    trace(pen, part);
  }
  context.fill();
  context.stroke();
}

/** From the wall in the middle to the tool above it. */
function drawGap({ context, ratio, palette, toPixels }, gap) {
  const [x, y] = toPixels([0, 0]), [, top] = toPixels([0, gap]), tick = 5 * ratio;
  context.strokeStyle = palette.haptic;
  context.lineWidth = 2 * ratio;
  context.beginPath();
  for (const at of [y, top]) {
    context.moveTo(x - tick, at);
    context.lineTo(x + tick, at);
  }
  context.moveTo(x, y);
  context.lineTo(x, top);
  context.stroke();
}
