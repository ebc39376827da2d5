// One cheap material for objects and tools: lit in the vertex shader by a lamp at the eye and a sky, cut by a plane.
import { Color, DoubleSide, ShaderMaterial, Vector4 } from 'three';

const vertexShader = `
uniform vec3 colour;
uniform vec3 inner;
varying vec3 front;
varying vec3 back;
varying vec3 place;

float shade(vec3 n, float sky) {
  return 0.30 + 0.16 * sky + 0.56 * max(dot(n, vec3(0.222, 0.400, 0.889)), 0.0);  // the lamp is above the eye, a little to the right
}

void main() {
  vec3 n = normalize(normalMatrix * normal);
  float sky = (modelMatrix * vec4(normal, 0.0)).z;
  front = colour * shade(n, sky);
  place = (modelMatrix * vec4(position, 1.0)).xyz;
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  // A smooth ridge has triangles that just face away: as the far side they would be specks.
  back = dot(n, normalize(seen.xyz)) < 0.15 ? front : inner * shade(-n, -sky);
  gl_Position = projectionMatrix * seen;
}`;

const fragmentShader = `
uniform float opacity;
uniform vec4 cut;
varying vec3 front;
varying vec3 back;
varying vec3 place;

void main() {
  if (dot(cut.xyz, place) > cut.w) discard;
  gl_FragColor = vec4(gl_FrontFacing ? front : back, opacity);
  #include <colorspace_fragment>
}`;

/**
 * @param cut      the plane n·x > w beyond which nothing is drawn; shared by those that are cut together
 * @param recedes  whether others in the same plane are seen in front of it
 */
export function clay({ colour, inner = colour, opacity = 1, cut = new Vector4(0, 0, 0, 1), recedes = false }) {
  return new ShaderMaterial({
    vertexShader, fragmentShader, side: DoubleSide, transparent: opacity < 1, depthWrite: opacity >= 1,
    polygonOffset: recedes, polygonOffsetFactor: 0, polygonOffsetUnits: 100,  // by their slope, ridges would recede behind their own far side
    uniforms: { colour: { value: new Color(colour) }, inner: { value: new Color(inner) }, opacity: { value: opacity }, cut: { value: cut } },
  });
}

export function setColour(material, colour, inner = colour) {
  material.uniforms.colour.value.set(colour);
  material.uniforms.inner.value.set(inner);
}

export function setOpacity(material, opacity) {
  material.uniforms.opacity.value = opacity;
  material.transparent = opacity < 1;
  material.depthWrite = opacity >= 1;
  material.needsUpdate = true;
}
