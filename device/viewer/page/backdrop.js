// A picture of the object with its depths, kept while neither it nor the eye moves: in software a hundred thousand triangles take a tenth of a
// second, and the tools before them a few milliseconds.
import { AlwaysDepth, Camera, DepthTexture, HalfFloatType, Mesh, PlaneGeometry, Scene, ShaderMaterial, WebGLRenderTarget } from 'three';

const vertexShader = `
varying vec2 place;
void main() {
  place = uv;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const fragmentShader = `
uniform sampler2D colours;
uniform sampler2D depths;
varying vec2 place;
void main() {
  gl_FragColor = texture2D(colours, place);
  gl_FragDepth = texture2D(depths, place).x;
  #include <colorspace_fragment>
}`;

export class Backdrop {
  constructor() {
    this.target = new WebGLRenderTarget(1, 1, { type: HalfFloatType, depthTexture: new DepthTexture(1, 1) });
    this.material = new ShaderMaterial({
      vertexShader, fragmentShader, depthTest: true, depthWrite: true,
      uniforms: { colours: { value: this.target.texture }, depths: { value: this.target.depthTexture } },
    });
    this.material.depthFunc = AlwaysDepth;
    this.quad = new Mesh(new PlaneGeometry(2, 2), this.material);
    this.quad.frustumCulled = false;
    this.scene = new Scene().add(this.quad);
    this.camera = new Camera();
    this.key = '';
  }

  /** Draws the scene as it is, or what was drawn of it at the last same key. */
  draw(renderer, scene, camera, key) {
    const canvas = renderer.domElement;
    const whole = `${key} ${canvas.width} ${canvas.height} ${camera.matrixWorld.elements.join()} ${camera.projectionMatrix.elements.join()}`;
    if (whole !== this.key) {
      this.key = whole;
      this.target.setSize(canvas.width, canvas.height);
      renderer.setRenderTarget(this.target);
      renderer.clear();
      renderer.render(scene, camera);
      renderer.setRenderTarget(null);
    }
    renderer.render(this.scene, this.camera);
  }
}
