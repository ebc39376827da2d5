// The clearance view: a cut through the tightest place, magnified until the gap can be seen.
import { Color, Mesh, MeshBasicMaterial, OrthographicCamera, PlaneGeometry, Vector3 } from 'three';
import { withUnit } from './format.js';

const autoFields = { least: 8e-6, gaps: 12 };  // of a picture's height: [m], and in gaps

/** The contact with the least gap that a frame has, recognised or not. */
export function tightest(frame) {
  const all = [...frame.contacts, ...frame.holding];
  return all.length === 0 ? null : all.reduce((best, contact) => (contact.gap < best.gap ? contact : best));
}

export class CloseUp {
  /** @param caption  an element for the gap, the scale and the magnification */
  constructor(box, caption, scaleBar) {
    this.box = box;
    this.caption = caption;
    this.scaleBar = scaleBar;
    this.camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    // What the wall is made of, seen where it is cut: a mesh is only a skin.
    this.wall = new Mesh(new PlaneGeometry(1, 1).translate(0, -0.5, 0), new MeshBasicMaterial({ color: '#888' }));
    this.field = null;  // height of what is shown [m]; null for what suits the gap
    this.place = null;
  }

  /** Aims at the tightest contact of a frame, or stays at the last one. */
  aim(frame, mainCamera) {
    const contact = tightest(frame);
    if (contact) {
      const normal = new Vector3(...contact.normal);
      const sideways = new Vector3().setFromMatrixColumn(mainCamera.matrixWorld, 2).cross(normal);
      if (sideways.lengthSq() < 1e-6) sideways.set(1, 0, 0).cross(normal);
      this.place = { point: new Vector3(...contact.point), normal, eye: normal.clone().cross(sideways.normalize()), gap: contact.gap };
    } else if (this.place) {
      this.place.gap = null;
    }
  }

  height() {
    return this.field ?? Math.max(autoFields.least, autoFields.gaps * Math.abs(this.place.gap ?? 1e-6));
  }

  /** Draws into the lower right of the picture. */
  draw(renderer, scene, background) {
    const { width, height } = this.box.getBoundingClientRect();
    const inside = renderer.domElement.getBoundingClientRect();
    const at = this.box.getBoundingClientRect();
    this.caption.textContent = this.describe(height);
    if (!this.place || width === 0) return;
    const field = this.height(), { point, normal, eye } = this.place;
    Object.assign(this.camera, { top: field / 2, bottom: -field / 2, right: field / 2 * width / height, left: -field / 2 * width / height, near: 0, far: 0.2 });
    this.camera.position.copy(point);
    this.camera.up.copy(normal);
    this.camera.lookAt(point.clone().sub(eye));
    this.camera.updateProjectionMatrix();
    const x = at.left - inside.left, y = inside.bottom - at.bottom;
    renderer.setScissorTest(true);
    renderer.setViewport(x, y, width, height);
    renderer.setScissor(x, y, width, height);
    this.wall.scale.set(4 * field, field, 1);
    this.wall.position.copy(point).addScaledVector(eye, -0.19);
    this.wall.quaternion.copy(this.camera.quaternion);
    const before = scene.background;
    scene.background = new Color(background);
    scene.add(this.wall);
    renderer.clearDepth();
    renderer.render(scene, this.camera);
    scene.remove(this.wall);
    scene.background = before;
    renderer.setScissorTest(false);
    this.drawScale(field, height);
  }

  describe(height) {
    if (!this.place) return 'Touch a wall to see the gap.';
    const gap = this.place.gap === null ? 'no contact now' : `gap ${withUnit(this.place.gap, 'm', 1e-10)}`;
    const magnification = height * 0.000264 / this.height();  // a CSS pixel is 1/96 inch
    return `${gap} · × ${Number(magnification.toPrecision(2)).toLocaleString('en')}`;
  }

  drawScale(field, height) {
    const length = 10 ** Math.floor(Math.log10(field * 0.6));
    this.scaleBar.style.width = `${length / field * height}px`;
    this.scaleBar.textContent = withUnit(length, 'm', 1e-10);
  }
}
