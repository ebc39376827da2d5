// Where a plane cuts the object and the tool, in double precision: pictures of a micrometre need no graphics processor, but all their digits.

export const leastGap = 2e-8;  // that the single precision of a mesh tells from none [m]

const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];

/**
 * A plane with axes in it, u to the right and v up.
 * @param origin  [m]
 * @param right   unit, in world axes; up is a unit one across
 */
export function cuttingPlane(origin, right, up) {
  return { origin, right, up, normal: cross(right, up) };
}

/** Where a pose puts a point. @param quaternion  unit x, y, z, w */
export function placed({ position, quaternion: [x, y, z, w] }, p) {
  const t = cross([x, y, z], p).map((v) => 2 * v), s = cross([x, y, z], t);
  return p.map((v, k) => v + w * t[k] + s[k] + position[k]);
}

/**
 * The cut of a mesh: segments, of a mesh whose triangles wind all the same way from head to tail.
 * @param centre  of the mesh, which its positions are relative to
 * @return {from, to, ends} a segment: [u, v] twice, and the edges of the mesh that it begins and ends at
 */
export function cutMesh({ centre, positions, indices }, { origin, right, up, normal }) {
  const count = positions.length / 3, heights = new Float64Array(count);
  const offset = dot(normal, centre.map((c, k) => c - origin[k]));
  for (let i = 0; i < count; ++i) {
    heights[i] = normal[0] * positions[3 * i] + normal[1] * positions[3 * i + 1] + normal[2] * positions[3 * i + 2] + offset;
  }
  const crossing = (a, b) => {
    if (a > b) [a, b] = [b, a];  // the same point for both triangles of an edge
    const share = heights[a] / (heights[a] - heights[b]);
    const p = [0, 1, 2].map((k) => positions[3 * a + k] + share * (positions[3 * b + k] - positions[3 * a + k]) + centre[k] - origin[k]);
    return { at: [dot(p, right), dot(p, up)], edge: a * count + b };
  };
  const segments = [];
  for (let t = 0; t < indices.length; t += 3) {
    const [a, b, c] = [indices[t], indices[t + 1], indices[t + 2]];
    const above = [heights[a] > 0, heights[b] > 0, heights[c] > 0];
    if (above[0] === above[1] && above[1] === above[2]) continue;
    // The corner that is alone, and the two that follow it round the triangle.
    const alone = above[1] === above[2] ? 0 : above[0] === above[2] ? 1 : 2;
    const [i, j, k] = [[a, b, c], [b, c, a], [c, a, b]][alone];
    const [first, second] = [crossing(i, j), crossing(i, k)];
    const [from, to] = heights[i] > 0 ? [first, second] : [second, first];
    segments.push({ from: from.at, to: to.at, ends: [from.edge, to.edge] });
  }
  return segments;
}

/** Segments that join head to tail, as loops of points; null where a surface is open, or more than two triangles meet. */
export function loopsOf(segments) {
  const after = new Map();
  for (const segment of segments) {
    if (after.has(segment.ends[0])) return null;
    after.set(segment.ends[0], segment);
  }
  const loops = [];
  while (after.size > 0) {
    const [[begin, first]] = after;
    const loop = [];
    let segment = first;
    do {
      after.delete(segment.ends[0]);
      loop.push(segment.from);
      if (segment.ends[1] === begin) break;
      segment = after.get(segment.ends[1]);
    } while (segment);
    if (!segment) return null;
    loops.push(loop);
  }
  return loops;
}

/** Whether loops go round a point an odd number of times. */
export function enclose(loops, [u, v]) {
  let isInside = false;
  for (const loop of loops) {
    loop.forEach(([u0, v0], i) => {
      const [u1, v1] = loop[(i + 1) % loop.length];
      if (v0 > v !== v1 > v && u < u0 + (v - v0) / (v1 - v0) * (u1 - u0)) isInside = !isInside;
    });
  }
  return isInside;
}

/**
 * The cut of a convex piece of a tool: a polygon of [u, v], of two points where the piece is an edge that lies in the plane, or empty.
 * @param thickness  how far from the plane an edge without faces may be [m]
 */
export function cutPiece({ vertices, faces }, pose, { origin, right, up, normal }, thickness) {
  const points = vertices.map((v) => placed(pose, v).map((x, k) => x - origin[k]));
  const heights = points.map((p) => dot(p, normal));
  const flat = (p) => [dot(p, right), dot(p, up)];
  if (faces.every((face) => face.length < 3)) return heights.every((h) => Math.abs(h) < thickness) ? points.map(flat) : crossings(points, heights, [[0, 1]]).map(flat);
  const edges = faces.flatMap((face) => face.map((i, n) => [i, face[(n + 1) % face.length]])).filter(([i, j]) => i < j);
  return aroundMiddle(crossings(points, heights, edges).map(flat));
}

function crossings(points, heights, edges) {
  return edges.filter(([i, j]) => (heights[i] > 0) !== (heights[j] > 0)).map(([i, j]) => {
    const share = heights[i] / (heights[i] - heights[j]);
    return points[i].map((v, k) => v + share * (points[j][k] - v));
  });
}

function aroundMiddle(points) {
  const middle = [0, 1].map((k) => points.reduce((sum, p) => sum + p[k], 0) / Math.max(points.length, 1));
  const angle = (p) => Math.atan2(p[1] - middle[1], p[0] - middle[0]);
  return points.sort((a, b) => angle(a) - angle(b));
}

/** The part of a polygon within −reach and reach in both directions. */
export function clipped(polygon, reach) {
  for (const axis of [0, 1]) {
    for (const sign of [1, -1]) {
      const inside = [];
      polygon.forEach((p, i) => {
        const q = polygon[(i + 1) % polygon.length], [a, b] = [reach - sign * p[axis], reach - sign * q[axis]];
        if (a >= 0) inside.push(p);
        if (a >= 0 !== b >= 0) inside.push(p.map((v, k) => v + a / (a - b) * (q[k] - v)));
      });
      polygon = inside;
    }
  }
  return polygon;
}

/** The same of a segment; null where it is outside. */
export function clippedSegment(from, to, reach) {
  const way = [to[0] - from[0], to[1] - from[1]];
  let [begin, end] = [0, 1];
  for (const axis of [0, 1]) {
    for (const sign of [1, -1]) {
      const room = reach - sign * from[axis], speed = sign * way[axis];
      if (speed === 0 && room < 0) return null;
      if (speed > 0) end = Math.min(end, room / speed);
      if (speed < 0) begin = Math.max(begin, room / speed);
    }
  }
  if (begin > end) return null;
  const at = (share) => [from[0] + share * way[0], from[1] + share * way[1]];
  return [at(begin), at(end)];
}

/** Height of a line over u; null where it is upright, or not there. */
function heightAt([from, to], u) {
  if (Math.min(from[0], to[0]) > u || Math.max(from[0], to[0]) < u || from[0] === to[0]) return null;
  return from[1] + (u - from[0]) / (to[0] - from[0]) * (to[1] - from[1]);
}

/**
 * The place near the middle where a tool is nearest above a wall: { u, wall, tool, isRight }; null where there is none within the field.
 * isRight: whether what is below the wall is at the right of its segment, from head to tail.
 * @param walls  segments  @param tools  polygons
 */
export function gapBetween(walls, tools, field) {
  const strip = 0.1 * field, reach = 0.5 * field;
  const isNear = ([[u0], [u1]]) => Math.min(u0, u1) <= strip && Math.max(u0, u1) >= -strip;
  const wallLines = walls.map(({ from, to }) => [from, to]).filter(isNear);
  const toolLines = tools.flatMap((polygon) => polygon.map((p, i) => [p, polygon[(i + 1) % polygon.length]])).filter(isNear);
  const places = [0, ...[...wallLines, ...toolLines].flat().map(([u]) => u).filter((u) => Math.abs(u) <= strip)];
  let best = null;
  for (const u of places) {
    const tool = Math.min(...toolLines.map((line) => heightAt(line, u) ?? Infinity));
    for (const line of wallLines) {
      const wall = heightAt(line, u);
      if (wall === null || wall > tool + leastGap || !(tool - wall < Math.min(reach, best ? best.tool - best.wall : Infinity))) continue;
      best = { u, wall, tool, isRight: line[1][0] > line[0][0] };
    }
  }
  return best;
}
