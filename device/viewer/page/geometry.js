// Geometries from what the server sends: the object's triangles, and the convex pieces of a tool.
import { BufferAttribute, BufferGeometry } from 'three';

const largeMesh = 60000;        // triangles, from which on normals are smooth: splitting vertices would triple the work
const creaseCosine = Math.cos(Math.PI / 6);

function faceNormal(p, a, b, c, out) {
  const ux = p[b] - p[a], uy = p[b + 1] - p[a + 1], uz = p[b + 2] - p[a + 2];
  const vx = p[c] - p[a], vy = p[c + 1] - p[a + 1], vz = p[c + 2] - p[a + 2];
  out[0] = uy * vz - uz * vy;
  out[1] = uz * vx - ux * vz;
  out[2] = ux * vy - uy * vx;
}

/** Area-weighted normals of all triangles, and their lengths. */
function triangleNormals(positions, indices) {
  const normals = new Float32Array(indices.length);
  const n = [0, 0, 0];
  for (let t = 0; t < indices.length; t += 3) {
    faceNormal(positions, 3 * indices[t], 3 * indices[t + 1], 3 * indices[t + 2], n);
    normals.set(n, t);
  }
  return normals;
}

function normalise(normals) {
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    normals[i] /= length;
    normals[i + 1] /= length;
    normals[i + 2] /= length;
  }
}

function smoothNormals(positions, indices, ofTriangles) {
  const normals = new Float32Array(positions.length);
  for (let i = 0; i < indices.length; ++i) {
    const t = i - (i % 3), v = 3 * indices[i];
    for (let k = 0; k < 3; ++k) normals[v + k] += ofTriangles[t + k];
  }
  normalise(normals);
  return normals;
}

/** Corners of their own, each with the mean normal of the triangles around it that bend less than the crease. */
function creased(positions, indices) {
  const ofTriangles = triangleNormals(positions, indices);
  const unit = ofTriangles.slice();
  normalise(unit);
  const around = Array.from({ length: positions.length / 3 }, () => []);
  for (let i = 0; i < indices.length; ++i) around[indices[i]].push(i - (i % 3));
  const corners = new Float32Array(3 * indices.length), normals = new Float32Array(3 * indices.length);
  for (let i = 0; i < indices.length; ++i) {
    const own = i - (i % 3);
    for (const t of around[indices[i]]) {
      const cosine = unit[t] * unit[own] + unit[t + 1] * unit[own + 1] + unit[t + 2] * unit[own + 2];
      if (cosine < creaseCosine) continue;
      for (let k = 0; k < 3; ++k) normals[3 * i + k] += ofTriangles[t + k];
    }
    for (let k = 0; k < 3; ++k) corners[3 * i + k] = positions[3 * indices[i] + k];
  }
  normalise(normals);
  return { corners, normals };
}

/** Triangles with normals that show what is sharp. */
export function objectGeometry(positions, indices) {
  const geometry = new BufferGeometry();
  if (indices.length / 3 > largeMesh) {
    geometry.setAttribute('position', new BufferAttribute(positions, 3));
    geometry.setIndex(new BufferAttribute(indices, 1));
    geometry.setAttribute('normal', new BufferAttribute(smoothNormals(positions, indices, triangleNormals(positions, indices)), 3));
  } else {
    const { corners, normals } = creased(positions, indices);
    geometry.setAttribute('position', new BufferAttribute(corners, 3));
    geometry.setAttribute('normal', new BufferAttribute(normals, 3));
  }
  return geometry;
}

/** Faces and edges of a tool of convex pieces, in the tool frame. A piece whose faces are edges has no surface. */
export function toolGeometry(pieces) {
  const corners = [], normals = [], lines = [];
  for (const { vertices, faces } of pieces) {
    for (const face of faces) {
      for (let i = 0; i < face.length; ++i) {
        const from = face[i], to = face[(i + 1) % face.length];
        if (from < to || face.length === 2 && i === 0) lines.push(...vertices[from], ...vertices[to]);
      }
      if (face.length < 3) continue;
      const n = [0, 0, 0];
      faceNormal(face.flatMap((v) => vertices[v]), 0, 3, 6, n);
      const length = Math.hypot(...n) || 1;
      for (let i = 1; i + 1 < face.length; ++i) {
        for (const v of [face[0], face[i], face[i + 1]]) {
          corners.push(...vertices[v]);
          normals.push(n[0] / length, n[1] / length, n[2] / length);
        }
      }
    }
  }
  const surface = new BufferGeometry();
  surface.setAttribute('position', new BufferAttribute(new Float32Array(corners), 3));
  surface.setAttribute('normal', new BufferAttribute(new Float32Array(normals), 3));
  return { surface, lines };
}
