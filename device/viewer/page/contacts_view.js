// The contacts of a frame: a disc and a normal for each, in the colour of its family, and a label.
import { CircleGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from 'three';
import { Arrow } from './arrow.js';
import { contactTypes, withUnit } from './format.js';
import { families } from './palette.js';

const disc = new CircleGeometry(1, 24);
const zAxis = new Vector3(0, 0, 1);
const mostShown = 24, mostLabels = 8;

class Mark extends Group {
  constructor() {
    super();
    this.disc = new Mesh(disc, new MeshBasicMaterial({ depthTest: false, transparent: true, opacity: 0.9, side: 2 }));
    this.disc.renderOrder = 5;
    this.arrow = new Arrow('#000');
    this.add(this.disc, this.arrow);
  }

  show(contact, size) {
    const colour = families[contactTypes[contact.type].family];
    const normal = new Vector3(...contact.normal), point = new Vector3(...contact.point);
    this.disc.material.color.set(colour);
    this.disc.position.copy(point);
    this.disc.quaternion.copy(new Quaternion().setFromUnitVectors(zAxis, normal));
    this.disc.scale.setScalar(0.022 * size);
    this.arrow.material.color.set(colour);
    this.arrow.set(point, normal, 0.16 * size, 0.006 * size);
  }
}

export class ContactsView extends Group {
  /** @param labels  an element over the picture */
  constructor(labels) {
    super();
    this.labels = labels;
    this.marks = [];
    this.size = 0.02;
  }

  show(contacts) {
    this.contacts = contacts.slice(0, mostShown);
    while (this.marks.length < this.contacts.length) {
      const mark = new Mark();
      this.marks.push(mark);
      this.add(mark);
    }
    this.marks.forEach((mark, i) => {
      mark.visible = i < this.contacts.length;
      if (mark.visible) mark.show(this.contacts[i], this.size);
    });
  }

  /** Puts the labels where the contacts are seen. @param covered  an element over the picture that none is to lie on */
  placeLabels(camera, width, height, covered) {
    const shown = this.visible && this.contacts ? this.contacts.slice(0, mostLabels) : [];
    while (this.labels.children.length < shown.length) this.labels.append(document.createElement('span'));
    const taken = [];
    [...this.labels.children].forEach((label, i) => {
      const contact = shown[i];
      label.hidden = !contact;
      if (!contact) return;
      const p = new Vector3(...contact.point).addScaledVector(new Vector3(...contact.normal), 0.19 * this.size).project(camera);
      const x = (p.x + 1) / 2 * width;
      let y = (1 - p.y) / 2 * height;
      while (taken.some((t) => Math.abs(t.x - x) < 70 && Math.abs(t.y - y) < 18)) y += 18;
      taken.push({ x, y });
      label.hidden = !covered.hidden && x + 80 > covered.offsetLeft && y + 10 > covered.offsetTop;
      const { short, family } = contactTypes[contact.type];
      const text = `${short} ${withUnit(contact.gap, 'm', 1e-8)}`;
      if (label.textContent !== text) {
        label.textContent = text;
        label.style.setProperty('--family', families[family]);
      }
      label.style.transform = `translate(${x.toFixed(1)}px, ${y.toFixed(1)}px)`;
    });
  }
}
