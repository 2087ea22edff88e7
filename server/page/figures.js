// The players: a figure and a name for each. All figures are drawn at once, and all names: each draw takes time.
import * as three from './three.js';
import {NameSheet} from './name_sheet.js';
import {playerFlag} from './protocol.js';

const most = 256;            // the slots that there are
const deadHeight = 0.25;
const nameAbove = 0.3;       // m over the eye
const reach = 1.5;           // m from the eye, within which figure and name are
const nameHeight = 0.026;    // of the view's height,
const minNamePx = 12;        // but at least so many pixels of the page,
const minNamePixels = 9;     // and so many that are drawn

// place: the eye, and 1 or, of the dead, deadHeight. turn: cosine and sine of heading and pitch.
const figureVertexShader = `
    attribute vec4 place;
    attribute vec4 turn;
    uniform float size;
    varying vec3 paint;
    #ifndef VISOR
    attribute vec3 tint;
    #endif
    vec2 turned(vec2 v, vec2 by) {
        return vec2(v.x * by.x - v.y * by.y, v.x * by.y + v.y * by.x);
    }
    void main() {
        vec3 surface = normal;
        vec3 at = position;
    #ifdef VISOR
        const vec3 tint = vec3(0.063, 0.078, 0.102);
        at.xz = turned(at.xz, turn.zw) * step(1.0, place.w);
        surface.xz = turned(surface.xz, turn.zw);
    #endif
        at = vec3(turned(at.xy, turn.xy), at.z * place.w);
        surface = normalize(vec3(turned(surface.xy, turn.xy), surface.z / place.w));
        vec3 sky = mix(vec3(0.226, 0.251, 0.284), vec3(0.78), 0.5 * surface.z + 0.5);
        float sun = 0.34 * max(dot(surface, vec3(0.452911, 0.251617, 0.855498)), 0.0);
        paint = tint * (sky + sun);
        gl_Position = projectionMatrix * modelViewMatrix * vec4(place.xyz + size * at, 1.0);
    }`;
const figureFragmentShader = `
    varying vec3 paint;
    void main() { gl_FragColor = vec4(paint, 1.0); }`;

// box: of the name on the sheet. size: of a name as high as wide, in parts of the view.
const nameVertexShader = `
    attribute vec4 place;
    attribute vec4 box;
    uniform vec2 size;
    uniform float above;
    varying vec2 at;
    void main() {
        at = box.xy + box.zw * vec2(position.x, 1.0 - position.y);
        vec2 corner = vec2((position.x - 0.5) * box.z / box.w, position.y + 0.2);
        gl_Position = projectionMatrix * modelViewMatrix * vec4(place.xy, place.z + above, 1.0);
        gl_Position.xy += 2.0 * size * corner * gl_Position.w;
    }`;
const nameFragmentShader = `
    varying vec2 at;
    uniform sampler2D sheet;
    void main() { gl_FragColor = texture2D(sheet, at); }`;

// A pawn of 1 m radius 0.28 whose eye is at the origin.
function pawnGeometry(sides) {
    const profile = [[0, -1.3], [0.3, -1.3], [0.3, -1.22], [0.2, -1.0], [0.17, -0.5], [0.24, -0.28], [0.13, -0.2],
        [0.18, -0.1], [0.2, 0], [0.18, 0.1], [0.1, 0.18], [0, 0.21]];
    const geometry = new three.LatheBufferGeometry(profile.map(([r, z]) => new three.Vector2(r, z)), sides);
    geometry.rotateX(Math.PI / 2);  // from y up to z up
    return geometry;
}

function visorGeometry() {
    const geometry = new three.BoxBufferGeometry(0.26, 0.26, 0.09);
    geometry.translate(0.14, 0, 0.02);
    return geometry;
}

function nameGeometry() {
    const geometry = new three.BufferGeometry();
    geometry.setAttribute('position', new three.BufferAttribute(new Float32Array([0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]), 3));
    geometry.setIndex([0, 1, 2, 0, 2, 3]);
    return geometry;
}

const instanced = width => new three.InstancedBufferAttribute(new Float32Array(most * width), width);

export class Figures {
    // sides: of a figure, which is round.
    constructor(sides) {
        this.sheet = new NameSheet();
        this.shown = [];
        this.metre = 1;
        this.attributes = {place: instanced(4), turn: instanced(4), tint: instanced(3), box: instanced(4)};
        this.size = {value: 1};
        this.nameUniforms = {size: {value: new three.Vector2()}, above: {value: 1}, sheet: {value: this.sheet.texture}};
        const figure = defines => new three.ShaderMaterial({vertexShader: figureVertexShader, fragmentShader: figureFragmentShader,
            defines, uniforms: {size: this.size}});
        this.names = this.instances(nameGeometry(), ['place', 'box'], new three.ShaderMaterial({vertexShader: nameVertexShader,
            fragmentShader: nameFragmentShader, uniforms: this.nameUniforms, transparent: true, depthWrite: false}));
        this.names.renderOrder = 1;  // over all that is transparent
        this.meshes = [this.instances(pawnGeometry(sides), ['place', 'turn', 'tint'], figure({})),
            this.instances(visorGeometry(), ['place', 'turn'], figure({VISOR: ''})), this.names];
        this.group = new three.Group();
        this.group.add(...this.meshes);
        this.frustum = new three.Frustum();
    }

    instances(shape, attributes, material) {
        const geometry = new three.InstancedBufferGeometry();
        geometry.copy(shape);
        for (const name of attributes) geometry.setAttribute(name, this.attributes[name]);
        const mesh = new three.Mesh(geometry, material);
        mesh.frustumCulled = false;
        return mesh;
    }

    // `looks(slot)`: {colour, label}; names and colours have changed.
    setLooks(looks) {
        this.looks = looks;
        this.sheet.clear();
        this.shown = [];
        this.tints = new Map();
    }

    // Nobody is there.
    forget() {
        this.shown = [];
    }

    // Players of a sample; metre: in map units.
    show(players, metre) {
        this.metre = metre;
        this.shown = [...players.values()].filter(({flags}) => (flags & playerFlag.spectator) === 0).map(player => {
            const heading = new three.Vector3(1, 0, 0).applyQuaternion(new three.Quaternion(...player.rotation));
            const flat = Math.hypot(heading.x, heading.y);
            return {slot: player.slot, eye: new three.Vector3(...player.position), height: player.flags & playerFlag.alive ? 1 : deadHeight,
                turn: flat > 0 ? [heading.x / flat, heading.y / flat, flat, heading.z] : [1, 0, 0, heading.z]};
        });
    }

    tintOf(slot) {
        if (!this.tints.has(slot)) this.tints.set(slot, new three.Color(this.looks(slot).colour).toArray());
        return this.tints.get(slot);
    }

    // Who is seen by this camera, the farthest first, for a picture of this size in pixels of the page; ratio: pixels that
    // are drawn for each. Figures are enlarged so many times; names are hidden by what is before them, or not, or left out.
    aim(camera, {width, height, ratio}, {times, names, namesHidden}) {
        const seen = this.seenBy(camera, times);
        const boxes = this.sheet.boxesOf(seen.map(({slot}) => {
            const {label, colour} = this.looks(slot);
            return {key: slot, text: label, colour};
        }));
        seen.forEach(({slot, eye, height: share, turn: by}, i) => {
            const {place, turn, tint, box} = this.attributes;
            place.setXYZW(i, eye.x, eye.y, eye.z, share);
            turn.setXYZW(i, ...by);
            tint.setXYZ(i, ...this.tintOf(slot));
            box.setXYZW(i, ...boxes[i]);
        });
        for (const attribute of Object.values(this.attributes)) attribute.needsUpdate = true;
        for (const mesh of this.meshes) {
            mesh.geometry.maxInstancedCount = seen.length;
            mesh.visible = seen.length > 0;
        }
        this.size.value = times * this.metre;
        this.names.visible = names && seen.length > 0;
        this.names.material.depthTest = namesHidden;
        const namePx = Math.max(nameHeight * height, minNamePx, minNamePixels / ratio);
        this.nameUniforms.size.value.set(namePx / width, namePx / height);
        this.nameUniforms.above.value = nameAbove * this.metre;
    }

    seenBy(camera, times) {
        camera.updateMatrixWorld();
        this.frustum.setFromMatrix(new three.Matrix4().multiplyMatrices(camera.projectionMatrix, camera.matrixWorldInverse));
        const sphere = new three.Sphere(undefined, reach * times * this.metre);
        const seen = this.shown.filter(({eye}) => {
            sphere.center = eye;
            return this.frustum.intersectsSphere(sphere);
        }).slice(0, most);
        const ahead = camera.getWorldDirection(new three.Vector3());
        return seen.sort((a, b) => b.eye.dot(ahead) - a.eye.dot(ahead));
    }
}
