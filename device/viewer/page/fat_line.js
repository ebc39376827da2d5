// Lines that a projector shows, some pixels wide: a quad a segment, widened in the vertex shader. No instances, which are slow in software.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, Mesh, ShaderMaterial, Vector4 } from 'three';

const leastWidth = 1.3;  // thinner ones have gaps [pixels of the canvas]

const vertexShader = `
attribute vec3 other;
attribute float side;
uniform float width;
uniform vec4 viewport;

void main() {
  vec4 here = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
  vec4 there = projectionMatrix * modelViewMatrix * vec4(other, 1.0);
  vec2 along = (there.xy / max(there.w, 1e-6) - here.xy / max(here.w, 1e-6)) * viewport.zw;
  vec2 across = length(along) > 0.0 ? normalize(vec2(-along.y, along.x)) : vec2(0.0);
  gl_Position = here;
  gl_Position.xy += side * across * width / viewport.zw * here.w;
  gl_Position.z -= 2e-4 * here.w;  // an edge is seen before the faces that meet in it
}`;

const fragmentShader = `
uniform vec3 colour;
uniform float opacity;

void main() {
  gl_FragColor = vec4(colour, opacity);
  #include <colorspace_fragment>
}`;

/** @param isOnTop  whether nothing hides it */
export function fatMaterial(colour, width, { opacity = 1, isOnTop = false } = {}) {
  const material = new ShaderMaterial({
    vertexShader, fragmentShader, side: DoubleSide, transparent: opacity < 1 || isOnTop, depthTest: !isOnTop,
    uniforms: { colour: { value: new Color(colour) }, width: { value: width }, opacity: { value: opacity }, viewport: { value: new Vector4() } },
  });
  material.pixelsWide = width;
  return material;
}

export function setLineColour(material, colour) {
  material.uniforms.colour.value.set(colour);
}

/** Room for separate segments: four corners each. */
function roomForSegments(count) {
  const attribute = (size) => new BufferAttribute(new Float32Array(4 * size * count), size);
  const side = attribute(1), index = new Uint32Array(6 * count);
  for (let i = 0; i < count; ++i) {
    side.array.set([1, -1, -1, 1], 4 * i);
    index.set([4 * i, 4 * i + 1, 4 * i + 2, 4 * i + 2, 4 * i + 1, 4 * i + 3], 6 * i);
  }
  return new BufferGeometry().setAttribute('position', attribute(3)).setAttribute('other', attribute(3)).setAttribute('side', side)
    .setIndex(new BufferAttribute(index, 1));
}

/** Writes segment i from one point of a list to another; a and b are where they begin in it. */
function writeSegment({ attributes: { position, other } }, i, points, a, b) {
  for (let k = 0; k < 3; ++k) {
    const at = 12 * i + k, from = points[a + k], to = points[b + k];
    position.array[at] = position.array[at + 3] = other.array[at + 6] = other.array[at + 9] = from;
    other.array[at] = other.array[at + 3] = position.array[at + 6] = position.array[at + 9] = to;
  }
}

class FatMesh extends Mesh {
  constructor(geometry, material) {
    super(geometry, material);
    this.onBeforeRender = (renderer) => {
      renderer.getCurrentViewport(material.uniforms.viewport.value);
      material.uniforms.width.value = Math.max(material.pixelsWide * renderer.getPixelRatio(), leastWidth);
    };
  }
}

/** Separate segments: [x, y, z, x, y, z, …], six numbers each. */
export function fatSegments(points, material) {
  const count = Math.floor(points.length / 6), geometry = roomForSegments(count);
  for (let i = 0; i < count; ++i) writeSegment(geometry, i, points, 6 * i, 6 * i + 3);
  return new FatMesh(geometry, material);
}

/** One line through points that change: its room grows, and is kept. */
export class FatLine extends FatMesh {
  constructor(material) {
    super(roomForSegments(32), material);
    this.frustumCulled = false;
    this.visible = false;
    this.points = [];
  }

  setPoints(points) {
    this.points = points;
    const count = Math.floor(points.length / 3) - 1;
    this.visible = count > 0;
    if (!this.visible) return;
    if (12 * count > this.geometry.attributes.position.array.length) {
      this.geometry.dispose();
      this.geometry = roomForSegments(2 * count);
    }
    for (let i = 0; i < count; ++i) writeSegment(this.geometry, i, points, 3 * i, 3 * i + 3);
    this.geometry.attributes.position.needsUpdate = this.geometry.attributes.other.needsUpdate = true;
    this.geometry.setDrawRange(0, 6 * count);
  }
}
