// An arrow from a point, and one that turns about its axis for a torque.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, TorusGeometry, Vector3 } from 'three';

const up = new Vector3(0, 1, 0);
const shaft = new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0);
const head = new ConeGeometry(1, 1, 16).translate(0, 0.5, 0);
const arc = new TorusGeometry(1, 0.14, 8, 32, 1.5 * Math.PI).rotateX(Math.PI / 2);

export class Arrow extends Group {
  constructor(colour, { turns = false } = {}) {
    super();
    this.material = new MeshBasicMaterial({ color: colour, depthTest: false, transparent: true });
    this.shaft = new Mesh(shaft, this.material);
    this.head = new Mesh(head, this.material);
    this.add(this.shaft, this.head);
    if (turns) this.add((this.arc = new Mesh(arc, this.material)));
    for (const part of this.children) part.renderOrder = 8;  // seen through the tool that it starts in
    this.visible = false;
  }

  /** Shows it from a point along a unit direction, of a length and with a shaft of a radius, all in world axes [m]. */
  set(from, direction, length, thickness) {
    this.visible = length > 2 * thickness;
    if (!this.visible) return;
    this.position.copy(from);
    this.quaternion.copy(new Quaternion().setFromUnitVectors(up, direction));
    const headLength = Math.min(6 * thickness, 0.5 * length);
    this.shaft.scale.set(thickness, length - headLength, thickness);
    this.head.scale.set(2.6 * thickness, headLength, 2.6 * thickness);
    this.head.position.y = length - headLength;
    if (this.arc) {
      this.arc.scale.setScalar(5 * thickness);
      this.arc.position.y = 0.45 * length;
    }
  }
}
