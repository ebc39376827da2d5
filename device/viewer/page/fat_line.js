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

/** Separate segments: [x, y, z, x, y, z, …], six numbers each. */
function segmentsGeometry(points) {
  const count = points.length / 6;
  const position = new Float32Array(12 * count), other = new Float32Array(12 * count), side = new Float32Array(4 * count);
  const index = new Uint32Array(6 * count);
  for (let i = 0; i < count; ++i) {
    const a = points.slice(6 * i, 6 * i + 3), b = points.slice(6 * i + 3, 6 * i + 6);
    [a, a, b, b].forEach((p, k) => position.set(p, 12 * i + 3 * k));
    [b, b, a, a].forEach((p, k) => other.set(p, 12 * i + 3 * k));
    side.set([1, -1, -1, 1], 4 * i);
    index.set([0, 1, 2, 2, 1, 3].map((v) => 4 * i + v), 6 * i);
  }
  return new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3)).setAttribute('other', new BufferAttribute(other, 3))
    .setAttribute('side', new BufferAttribute(side, 1)).setIndex(new BufferAttribute(index, 1));
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

export function fatSegments(points, material) {
  return new FatMesh(segmentsGeometry(Array.from(points)), material);
}

/** One line through points that change. */
export class FatLine extends FatMesh {
  constructor(material) {
    super(new BufferGeometry(), material);
    this.frustumCulled = false;
    this.visible = false;
  }

  setPoints(points) {
    this.visible = points.length >= 6;
    if (!this.visible) return;
    const segments = [];
    for (let i = 0; i + 6 <= points.length; i += 3) segments.push(...points.slice(i, i + 6));
    this.geometry.dispose();
    this.geometry = segmentsGeometry(segments);
  }
}
