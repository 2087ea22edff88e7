// Pictures in a corner of the large one, each kept until it is drawn anew.
import * as three from './three.js';

const vertexShader = `
    varying vec2 at;
    void main() {
        at = 0.5 * position.xy + 0.5;
        gl_Position = vec4(position.xy, 0.0, 1.0);
    }`;
const fragmentShader = `
    varying vec2 at;
    uniform sampler2D picture;
    void main() { gl_FragColor = texture2D(picture, at); }`;

export class SmallPictures {
    // finer: how many times as fine as they are shown they are drawn, for smooth edges.
    constructor(renderer, finer) {
        Object.assign(this, {renderer, finer});
        this.kept = [];  // {target, of: what is seen in it}
        this.picture = {value: null};
        const cover = new three.BufferGeometry();
        cover.setAttribute('position', new three.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
        this.sheet = new three.Mesh(cover, new three.ShaderMaterial({vertexShader, fragmentShader, uniforms: {picture: this.picture},
            depthTest: false, depthWrite: false}));
        this.sheet.frustumCulled = false;
        this.camera = new three.Camera();
    }

    // Whether picture i shows this already, whatever the time, in this size in pixels.
    shows(i, of, width, height) {
        const kept = this.kept[i];
        return kept?.of === of && kept.target.width === width * this.finer && kept.target.height === height * this.finer;
    }

    // Calls `draw` to draw picture i anew.
    draw(i, of, width, height, draw) {
        if (!this.shows(i, of, width, height)) {
            this.kept[i]?.target.dispose();
            this.kept[i] = {of, target: new three.WebGLRenderTarget(width * this.finer, height * this.finer)};
        }
        this.renderer.setRenderTarget(this.kept[i].target);
        draw();
        this.renderer.setRenderTarget(null);
    }

    // Puts picture i where the renderer's viewport is.
    paste(i) {
        this.picture.value = this.kept[i].target.texture;
        this.renderer.render(this.sheet, this.camera);
    }
}
