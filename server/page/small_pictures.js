// Pictures in a corner of the large one, each kept until it is drawn anew.
import * as three from './three.js';
import {Cover} from './cover.js';

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
        this.cover = new Cover({fragmentShader, uniforms: {picture: this.picture}, depthTest: false, depthWrite: false});
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
        this.cover.draw(this.renderer);
    }
}
