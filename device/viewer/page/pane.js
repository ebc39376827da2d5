// One picture with its words: a stage, its frames, and what is written over it.
import { Vector3 } from 'three';
import { counted, countTypes, withUnit } from './format.js';
import { KeyboardEye } from './keyboard_eye.js';
import { StageView } from './stage_view.js';
import { readingAt } from './strips.js';

const axes = { x: [1, 0, 0], y: [0, 1, 0], z: [0, 0, 1] };

/** Writes rows of a name and a value, and touches only what has changed. */
function setTable(list, rows) {
  while (list.children.length < 2 * rows.length) list.append(document.createElement('dt'), document.createElement('dd'));
  rows.flat().forEach((text, i) => {
    if (list.children[i].textContent !== text) list.children[i].textContent = text;
  });
}

export class Pane {
  /** @param section  the element of the picture, with its parts */
  constructor(section, timeline) {
    this.section = section;
    this.timeline = timeline;
    this.parts = Object.fromEntries([...section.querySelectorAll('[data-part]')].map((part) => [part.dataset.part, part]));
    this.view = new StageView(this.parts);
    this.eye = new KeyboardEye(this.view);
  }

  setStage(stage) {
    this.stage = stage;
    this.view.setStage(stage);
    this.parts.title.textContent = stage.title;
    this.parts.hint.textContent = stage.hint;
    const variant = stage.variant || (stage.clearance === null ? '' : `clearance ${withUnit(stage.clearance, 'm')}`);
    this.parts.meta.textContent =
      `${variant} · ${counted(stage.triangles, 'triangle')} · ${stage.stiffness} N/m · margin ${withUnit(stage.margin, 'm')} · ${stage.method}, ${stage.scalar}`;
  }

  show(index) {
    const frame = this.timeline.frames[index];
    if (frame) this.view.showFrame(frame, this.timeline.frames, index);
  }

  /** The figures of a time, as the strips have them. */
  write(time) {
    const { frame } = this.view;  // none where another stage has just come
    const read = (id) => readingAt(this.timeline.samples, id, time);
    const types = countTypes(frame?.contacts ?? []).map(([{ short }, count]) => (count > 1 ? `${count} ${short}` : short)).join(', ');
    const rows = [
      ['force', read('force')], ['torque', read('torque')], ['contacts', types || 'none'], ['apart', `${read('offset')}, ${read('turn')}`], ['state', frame?.status ?? '–'],
    ];
    setTable(this.parts.readings, rows);
  }

  setLook(values) {
    this.look = values;
    const { view } = this;
    view.object.setLook(values.look);
    view.contacts.visible = values.contacts;
    view.arrows.visible = values.arrows;
    view.trace.visible = values.trace;
    view.follows = values.follow;
    view.magnifies = values.magnify;
    view.closeUp.field = values.field ? 10 ** values.field : null;
    this.parts.closeUp.hidden = !values.magnify;
    view.changed();
  }

  /** The half that hides the inside, seen from where the eye is now. */
  cut() {
    const { section, depth } = this.look ?? {};
    const { object, camera } = this.view;
    if (!section || section === 'none' || !object.halfSize) return object.setSection(null);
    const toEye = camera.position.clone().sub(object.position);
    const direction = section === 'eye' ? toEye.normalize() : new Vector3(...axes[section]);
    if (direction.dot(toEye) < 0) direction.negate();
    const reach = Math.abs(direction.x) * object.halfSize.x + Math.abs(direction.y) * object.halfSize.y + Math.abs(direction.z) * object.halfSize.z;
    return object.setSection(direction.toArray(), -depth * reach);
  }

  draw() {
    this.cut();
    this.view.draw();
  }
}
