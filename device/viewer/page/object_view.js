// The object: clay that can be seen through or cut open.
import { Group, Mesh, Vector3, Vector4 } from 'three';
import { clay, setColour, setOpacity } from './clay.js';
import { creaseLines } from './creases.js';
import { fatMaterial, fatSegments, setLineColour } from './fat_line.js';
import { objectGeometry } from './geometry.js';

const mostTrianglesWithEdges = 20000;
const everything = 1e9;

export class ObjectView extends Group {
  constructor() {
    super();
    this.cut = new Vector4(0, 0, 0, everything);
    this.material = clay({ colour: '#ccc', cut: this.cut, recedes: true });
    this.edgeMaterial = fatMaterial('#555', 1.2);
  }

  setMesh({ centre, positions, indices }) {
    for (const child of this.children) child.geometry.dispose();
    this.clear();
    const geometry = objectGeometry(positions, indices);
    geometry.computeBoundingSphere();
    geometry.computeBoundingBox();
    this.position.fromArray(centre);
    this.triangleCount = indices.length / 3;
    this.radius = geometry.boundingSphere.radius;
    this.halfSize = geometry.boundingBox.getSize(new Vector3()).multiplyScalar(0.5);
    this.mesh = new Mesh(geometry, this.material);
    this.mesh.renderOrder = 1;
    this.add(this.mesh);
    if (this.triangleCount <= mostTrianglesWithEdges) this.addEdges(creaseLines(positions, indices));
    this.setLook(this.look ?? 'solid');
  }

  addEdges(points) {
    if (points.length === 0) return;
    this.edges = fatSegments(points, this.edgeMaterial);
    this.add(this.edges);
  }

  /** @param look  solid, glass, or hidden */
  setLook(look) {
    this.look = look;
    this.visible = look !== 'hidden';
    setOpacity(this.material, look === 'glass' ? 0.28 : 1);
    if (this.mesh) this.mesh.renderOrder = look === 'glass' ? 6 : 1;
  }

  /** Cuts off what is farther along a world direction than a distance from the centre [m]; no direction cuts nothing. */
  setSection(direction, distance = 0) {
    if (!direction) return this.cut.set(0, 0, 0, everything);
    this.cut.set(...direction, direction[0] * this.position.x + direction[1] * this.position.y + direction[2] * this.position.z + distance);
    return undefined;
  }

  setColours({ object, inner, edges }) {
    setColour(this.material, object, inner);
    setLineColour(this.edgeMaterial, edges);
  }
}
