// The forms of the page: gallery, settings of the scene, and what the picture shows.
import { withUnit } from './format.js';

/** An element with attributes, properties and children. */
export function element(tag, attributes = {}, ...children) {
  const node = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) node.addEventListener(name.slice(2), value);
    else if (name in node) node[name] = value;
    else node.setAttribute(name, value);
  }
  node.append(...children);
  return node;
}

function select(label, name, options, value) {
  const node = element('select', { name }, ...options.map(([id, text]) => element('option', { value: id, textContent: text })));
  node.value = value;
  return element('label', {}, label, node);
}

function slider(label, name, { min, max, step, value }, write) {
  const output = element('output', { textContent: write(value) });
  const input = element('input', { type: 'range', name, min, max, step, value });
  input.value = value;
  input.addEventListener('input', () => (output.textContent = write(Number(input.value))));
  return element('label', {}, label, output, input);
}

function check(label, name, checked) {
  return element('label', { className: 'check' }, element('input', { type: 'checkbox', name, checked }), label);
}

/** The scenes, a button each. */
export function showGallery(list, gallery, choose) {
  list.replaceChildren(...gallery.map(({ id, title, hint }) =>
    element('button', { type: 'button', onclick: () => choose({ scene: id }), 'data-scene': id }, title, element('small', { textContent: hint }))));
}
export function markScene(list, scene) {
  for (const button of list.children) button.setAttribute('aria-current', String(button.dataset.scene === scene));
}

const ownClearance = 'own';
const margins = [1e-7, 1e-6, 1e-5];

/** The settings of the stage on show; any change asks for another stage. */
export function showSettings(form, hello, stage, choose) {
  const entry = hello.gallery.find(({ id }) => id === stage.scene);
  const hasOwn = entry.clearance && stage.clearance !== null;
  const variants = entry.variants.map((label) => [label, label]);
  if (entry.clearance) variants.push([ownClearance, 'a clearance of your own']);
  const fields = [element('legend', { textContent: 'Scene' })];
  fields.push(select('Tool', 'tool', hello.tools.map(({ id, label }) => [id, label]), stage.tool_kind));
  if (variants.length > 1) fields.push(select('Which', 'variant', variants, hasOwn ? ownClearance : stage.variant));
  if (hasOwn) {
    fields.push(slider('Clearance', 'clearance', { min: -7, max: -2.5, step: 0.05, value: Math.log10(Math.max(stage.clearance, 1e-7)) }, (v) => withUnit(10 ** v, 'm')));
  }
  const render = [
    element('legend', { textContent: 'Rendering' }),
    slider('Stiffness', 'stiffness', { min: 100, max: 3000, step: 50, value: Math.round(stage.stiffness) }, (v) => `${v} N/m`),
    select('Margin', 'margin', [...new Set([...margins, stage.margin])].sort((a, b) => a - b).map((m) => [m, withUnit(m, 'm')]), stage.margin),
    select('Contact method', 'method', hello.methods.map(({ id, label }) => [id, label]), stage.method),
    select('Scalar', 'scalar', hello.scalars.map(({ id, label }) => [id, label]), stage.scalar),
  ];
  const focused = form.contains(document.activeElement) && document.activeElement.name;
  form.replaceChildren(...[fields, render].filter((group) => group.length > 1).map((group) => element('fieldset', {}, ...group)));
  if (focused) form.elements[focused]?.focus();  // so that its next key is heard
  form.onchange = () => {
    const values = Object.fromEntries(new FormData(form));
    const request = { scene: stage.scene, stiffness: Number(values.stiffness), margin: Number(values.margin), tool: values.tool, method: values.method, scalar: values.scalar };
    if (values.variant === ownClearance) request.clearance = values.clearance === undefined ? 1e-4 : 10 ** Number(values.clearance);
    else if (values.variant !== undefined) request.variant = values.variant;
    choose(request);
  };
}

/** What suits a scene where nobody has said otherwise. */
export const sceneLooks = {
  cavity: { look: 'glass' }, tunnel: { look: 'glass' }, plate: { look: 'glass' },
  spline: { section: 'y' }, shaft: { section: 'y' }, peg: { section: 'y' },
};
export const defaultLook = {
  look: 'solid', section: 'none', depth: 0, contacts: true, arrows: true, trace: true, follow: false, magnify: false, field: 0,
};

/** What the picture shows. @param change  called with all values whenever one changes */
export function showLook(form, values, change) {
  form.replaceChildren(element('fieldset', {},
    element('legend', { textContent: 'Picture' }),
    select('Object', 'look', [['solid', 'solid'], ['glass', 'glass'], ['hidden', 'hidden']], values.look),
    select('Section', 'section', [['none', 'none'], ['x', 'across x'], ['y', 'across y'], ['z', 'across z'], ['eye', 'towards the eye']], values.section),
    slider('Depth of the section', 'depth', { min: -1, max: 1, step: 0.01, value: values.depth }, (v) => `${Math.round(100 * v)} %`),
    check('Contacts by type', 'contacts', values.contacts),
    check('Force and torque', 'arrows', values.arrows),
    check('Trace of the tip', 'trace', values.trace),
    check('Follow the tool', 'follow', values.follow),
    check('Clearance view', 'magnify', values.magnify),
    slider('Its field', 'field', { min: -6, max: -2, step: 0.05, value: values.field || -6 }, (v) => (v <= -6 ? 'suits the gap' : withUnit(10 ** v, 'm'))),
    element('button', { type: 'button', name: 'reset', textContent: 'Reset the view' })));
  form.oninput = () => change(readLook(form));
}

function readLook(form) {
  const { look, section, depth, contacts, arrows, trace, follow, magnify, field } = form.elements;
  return {
    look: look.value, section: section.value, depth: Number(depth.value), contacts: contacts.checked, arrows: arrows.checked,
    trace: trace.checked, follow: follow.checked, magnify: magnify.checked, field: Number(field.value) <= -6 ? 0 : Number(field.value),
  };
}
