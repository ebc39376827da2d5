// One of the two tools: red and translucent where the hand is, grey where the tool may be.
import { Box3, Group, Mesh, Vector3 } from 'three';
import { clay } from './clay.js';
import { fatMaterial, fatSegments, setLineColour } from './fat_line.js';
import { toolGeometry } from './geometry.js';

export class ToolView extends Group {
  constructor({ opacity, lineWidth, renderOrder }) {
    super();
    this.surfaceMaterial = clay({ colour: '#888', opacity, recedes: opacity < 1 });
    this.lineMaterial = fatMaterial('#000', lineWidth, { opacity: opacity < 1 ? 0.9 : 1 });
    this.renderOrder = renderOrder;
  }

  setPieces(pieces) {
    for (const child of [...this.children]) child.geometry.dispose();
    this.clear();
    const { surface, lines } = toolGeometry(pieces);
    this.surface = new Mesh(surface, this.surfaceMaterial);
    const edges = fatSegments(lines, this.lineMaterial);
    this.isLine = surface.getAttribute('position').count === 0;
    this.surface.renderOrder = edges.renderOrder = this.renderOrder;
    this.add(this.surface, edges);
    surface.computeBoundingSphere();
    const box = new Box3().setFromPoints(pieces.flatMap((piece) => piece.vertices.map((v) => new Vector3(...v))));
    this.middle = box.getCenter(new Vector3());
    this.radius = Math.max(...pieces.flatMap((piece) => piece.vertices.map((v) => Math.hypot(...v))));
  }

  setColours(surface, line) {
    this.surfaceMaterial.uniforms.colour.value.set(surface);
    this.surfaceMaterial.uniforms.inner.value.set(surface);
    setLineColour(this.lineMaterial, line);
  }
}
