// A picture of the object, kept below the canvas while neither it nor the eye moves. In software a hundred thousand triangles take a tenth of a
// second, and every pixel counts: so then the canvas is transparent, and holds the tools alone, with the object's depths only where they are.
import { AlwaysDepth, BufferAttribute, BufferGeometry, Camera, DepthTexture, Mesh, Scene, ShaderMaterial, SRGBColorSpace, Vector3, WebGLRenderTarget } from 'three';

const columns = 40, rows = 24;  // of cells, of which those get depths that something moving is seen in

const vertexShader = `
varying vec2 place;
void main() {
  place = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const fragmentShader = `
uniform sampler2D depths;
varying vec2 place;
void main() {
  gl_FragColor = vec4(0.0);
  gl_FragDepth = texture2D(depths, place).x;
}`;

/** Which cells of the picture spheres and lines of the scene are seen in. */
export class Cells {
  constructor() {
    this.isTaken = new Uint8Array(columns * rows);
  }

  clear() {
    this.isTaken.fill(0);
  }
  get taken() {
    return [...this.isTaken.keys()].filter((cell) => this.isTaken[cell]);
  }

  /** A rectangle, and a little more, in the coordinates of the picture: −1 to 1. */
  addBox(left, bottom, right, top) {
    const of = (v, count) => Math.min(Math.max(Math.floor((v + 1) / 2 * count), 0), count - 1);
    const slack = 0.02;
    if (!(right + slack > -1 && left - slack < 1 && top + slack > -1 && bottom - slack < 1)) return;
    const [x0, x1, y0, y1] = [of(left - slack, columns), of(right + slack, columns), of(bottom - slack, rows), of(top + slack, rows)];
    for (let y = y0; y <= y1; ++y) this.isTaken.fill(1, y * columns + x0, y * columns + x1 + 1);
  }
  addSphere(camera, centre, radius) {
    const away = -centre.clone().applyMatrix4(camera.matrixWorldInverse).z;
    if (away <= 1.1 * radius) return this.isTaken.fill(1);
    const { x, y } = centre.clone().project(camera), p = camera.projectionMatrix.elements;
    const size = radius / Math.sqrt(away * away - radius * radius);
    return this.addBox(x - size * p[0], y - size * p[5], x + size * p[0], y + size * p[5]);
  }
  /** @param points  [x, y, z, x, y, z, …] in the scene */
  addLine(camera, points) {
    let before = null;
    for (let i = 0; i + 3 <= points.length; i += 3) {
      const now = new Vector3().fromArray(points, i).project(camera);
      if (before) this.addBox(Math.min(before.x, now.x), Math.min(before.y, now.y), Math.max(before.x, now.x), Math.max(before.y, now.y));
      before = now;
    }
  }
}

/** A corner for each crossing of the grid, and the triangles of the cells that are taken. */
function gridGeometry() {
  const position = new Float32Array(3 * (columns + 1) * (rows + 1));
  for (let y = 0; y <= rows; ++y) {
    for (let x = 0; x <= columns; ++x) position.set([2 * x / columns - 1, 2 * y / rows - 1, 0], 3 * (y * (columns + 1) + x));
  }
  return new BufferGeometry().setAttribute('position', new BufferAttribute(position, 3)).setIndex(new BufferAttribute(new Uint16Array(6 * columns * rows), 1));
}

function takeCells(geometry, cells) {
  const indices = geometry.getIndex();
  cells.forEach((cell, i) => {
    const a = Math.floor(cell / columns) * (columns + 1) + cell % columns, b = a + columns + 1;
    indices.array.set([a, a + 1, b + 1, a, b + 1, b], 6 * i);
  });
  indices.needsUpdate = true;
  geometry.setDrawRange(0, 6 * cells.length);
}

export class Backdrop {
  /** @param canvas  of the picture; another one is put below it */
  constructor(canvas) {
    this.below = document.createElement('canvas');
    this.below.className = 'backdrop';
    canvas.before(this.below);
    this.target = new WebGLRenderTarget(1, 1, { depthTexture: new DepthTexture(1, 1), colorSpace: SRGBColorSpace });
    this.target.isXRRenderTarget = true;  // with colours as a canvas has them, so that they can be copied to one
    this.material = new ShaderMaterial({ vertexShader, fragmentShader, colorWrite: false, uniforms: { depths: { value: this.target.depthTexture } } });
    this.material.depthFunc = AlwaysDepth;
    this.grid = new Mesh(gridGeometry(), this.material);
    this.grid.frustumCulled = false;
    this.scene = new Scene().add(this.grid);
    this.camera = new Camera();
    this.cells = new Cells();
    this.key = this.seen = '';
  }

  /**
   * Whether there is a picture of the object as it is to be seen now. One is made as soon as the same is to be seen twice.
   * @param key         changes with whatever changes the object
   * @param drawObject  with its background
   */
  holds(renderer, camera, key, drawObject) {
    const { width, height } = renderer.domElement;
    const wanted = `${key} ${width} ${height} ${camera.matrixWorld.elements.join()} ${camera.projectionMatrix.elements.join()}`;
    if (wanted === this.key) return true;
    const isSeenAgain = wanted === this.seen;
    this.seen = wanted;
    if (!isSeenAgain) return false;
    this.key = wanted;
    this.take(renderer, drawObject);
    return true;
  }

  take(renderer, drawObject) {
    const canvas = renderer.domElement, { width, height } = canvas;
    this.target.setSize(width, height);
    renderer.setRenderTarget(this.target);
    renderer.clear();
    drawObject();
    renderer.setRenderTarget(null);
    const gl = renderer.getContext();
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, renderer.properties.get(this.target).__webglFramebuffer);
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, null);
    Object.assign(this.below, { width, height });
    this.below.getContext('2d', { willReadFrequently: true, alpha: false }).drawImage(canvas, 0, 0);  // in memory
  }

  /** A transparent picture with the depths of the object where others are. @param addCells  called with the cells to be taken */
  draw(renderer, addCells) {
    renderer.setClearAlpha(0);
    renderer.clear();
    this.cells.clear();
    addCells(this.cells);
    takeCells(this.grid.geometry, this.cells.taken);
    renderer.render(this.scene, this.camera);
  }
}
