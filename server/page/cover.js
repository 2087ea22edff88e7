// Covers the viewport: every pixel of it is one of the shader's, which knows where it is, `at`, from 0 to 1.
import * as three from './three.js';

const vertexShader = `
    varying vec2 at;
    void main() {
        at = 0.5 * position.xy + 0.5;
        gl_Position = vec4(position.xy, 0.0, 1.0);
    }`;

export class Cover {
    // `material`: of three.ShaderMaterial.
    constructor(material) {
        const triangle = new three.BufferGeometry();
        triangle.setAttribute('position', new three.BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
        this.sheet = new three.Mesh(triangle, new three.ShaderMaterial({vertexShader, ...material}));
        this.sheet.frustumCulled = false;
        this.camera = new three.Camera();
    }

    draw(renderer) {
        renderer.render(this.sheet, this.camera);
    }
}
