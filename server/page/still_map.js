// The map as it is seen from outside: as long as nobody moves the view it is drawn once, kept with its depths, and put under
// what moves.
import * as three from './three.js';
import {Cover} from './cover.js';

const fragmentShader = `
    varying vec2 at;
    uniform sampler2D picture;
    uniform sampler2D depths;
    void main() {
        gl_FragColor = texture2D(picture, at);
        gl_FragDepthEXT = texture2D(depths, at).r;
    }`;

export class StillMap {
    constructor(renderer) {
        this.renderer = renderer;
        this.canKeep = Boolean(renderer.extensions.get('EXT_frag_depth') && renderer.extensions.get('WEBGL_depth_texture'));
        this.uniforms = {picture: {value: null}, depths: {value: null}};
        this.cover = new Cover({fragmentShader, uniforms: this.uniforms, extensions: {fragDepth: true}, depthFunc: three.AlwaysDepth});
        this.target = null;
        this.kept = '';  // what the target shows
        this.last = '';  // what was asked for last
        renderer.domElement.addEventListener('webglcontextrestored', () => { this.kept = this.last = ''; });
    }

    // Draws the map, of which `key` says all that is seen, in a picture of so many pixels. `draw`: draws it.
    draw(key, width, height, draw) {
        const of = `${width} ${height} ${key}`;
        const stands = of === this.last;
        this.last = of;
        if (!this.canKeep || !stands) return draw();
        if (of !== this.kept) this.keep(of, width, height, draw);
        this.cover.draw(this.renderer);
    }

    keep(of, width, height, draw) {
        if (this.target?.width !== width || this.target.height !== height) this.makeTarget(width, height);
        this.renderer.setRenderTarget(this.target);
        this.renderer.clear();
        draw();
        this.renderer.setRenderTarget(null);
        this.kept = of;
    }

    makeTarget(width, height) {
        this.target?.dispose();
        this.target?.depthTexture.dispose();
        this.target = new three.WebGLRenderTarget(width, height, {
            minFilter: three.NearestFilter, magFilter: three.NearestFilter, stencilBuffer: false});
        this.target.depthTexture = new three.DepthTexture(width, height, three.UnsignedIntType);
        this.uniforms.picture.value = this.target.texture;
        this.uniforms.depths.value = this.target.depthTexture;
    }
}
