// The lines of an object that are worth drawing: where it ends, and where it bends by much along a line that leads somewhere.

const cosineOfCrease = Math.cos(40 * Math.PI / 180);

function unitNormal(p, a, b, c) {
  const u = [0, 1, 2].map((k) => p[3 * b + k] - p[3 * a + k]), v = [0, 1, 2].map((k) => p[3 * c + k] - p[3 * a + k]);
  const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
  const length = Math.hypot(...n) || 1;
  return n.map((x) => x / length);
}

/** Edges that bend, or have one triangle or more than two: [from, to] each, of vertices. */
function bentEdges(positions, indices) {
  const edges = new Map();
  const count = positions.length / 3;
  for (let t = 0; t < indices.length; t += 3) {
    const corners = [indices[t], indices[t + 1], indices[t + 2]], normal = unitNormal(positions, ...corners);
    corners.forEach((a, i) => {
      const b = corners[(i + 1) % 3], key = Math.min(a, b) * count + Math.max(a, b), other = edges.get(key);
      if (other) {
        other.isBent = ++other.triangles > 2 || other.normal.reduce((sum, v, k) => sum + v * normal[k], 0) < cosineOfCrease;
      } else {
        edges.set(key, { ends: [a, b], normal, triangles: 1, isBent: true });
      }
    });
  }
  return [...edges.values()].filter(({ isBent }) => isBent).map(({ ends }) => ends);
}

/** Without edges that lead nowhere, and those that lead to them alone: on a rough surface they are scratches. */
function joinedEdges(edges) {
  const meetings = new Map();  // of a vertex: its edges
  for (const edge of edges) for (const end of edge) meetings.set(end, (meetings.get(end) ?? new Set()).add(edge));
  const loose = [...meetings.values()].filter((meeting) => meeting.size === 1);
  while (loose.length > 0) {
    const [edge] = loose.pop();
    for (const end of edge ?? []) {
      const meeting = meetings.get(end);
      meeting.delete(edge);
      if (meeting.size === 1) loose.push(meeting);
    }
  }
  return edges.filter((edge) => meetings.get(edge[0]).has(edge));
}

/** @return [x, y, z, x, y, z, …], two points a line */
export function creaseLines(positions, indices) {
  return joinedEdges(bentEdges(positions, indices)).flat().flatMap((v) => [...positions.subarray(3 * v, 3 * v + 3)]);
}
