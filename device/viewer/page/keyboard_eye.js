// The keyboard as the eye: keys of the picture that turn it about what is looked at, and bring it nearer.
import { Spherical, Vector3 } from 'three';

const turns = { KeyJ: [-1, 0], KeyL: [1, 0], KeyI: [0, -1], KeyK: [0, 1] };
const zooms = { '+': 1, '=': 1, '-': -1, '−': -1 };  // by what is written on them, wherever they are
const turnAPress = Math.PI / 36, zoomAPress = 1.1;

export class KeyboardEye {
  constructor(view) {
    this.view = view;
    view.canvas.addEventListener('keydown', (event) => this.down(event));
  }

  down(event) {
    if (event.ctrlKey || event.metaKey) return;
    if (event.code in turns) this.turn(...turns[event.code].map((v) => v * turnAPress));
    else if (event.key in zooms) this.zoom(zoomAPress ** -zooms[event.key]);
    else if (event.key === 'Home') this.view.resetCamera();
    else return;
    event.preventDefault();
    this.view.changed();
  }

  turn(around, down) {
    this.move((way) => {
      const { radius, phi, theta } = new Spherical().setFromVector3(way);
      return way.setFromSphericalCoords(radius, Math.min(Math.max(phi + down, 0.01), Math.PI - 0.01), theta + around);
    });
  }
  zoom(factor) {
    const { minDistance, maxDistance } = this.view.controls;
    this.move((way) => way.setLength(Math.min(Math.max(way.length() * factor, minDistance), maxDistance)));
  }

  /** @param change  of the way from what is looked at to the eye, in axes of which y is up */
  move(change) {
    const { camera, controls } = this.view;
    const { x, y, z } = camera.position.clone().sub(controls.target);
    const way = change(new Vector3(x, z, -y));
    camera.position.copy(controls.target).add(new Vector3(way.x, -way.z, way.y));
    controls.update();
  }
}
