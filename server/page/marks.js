// The cameras as seen from outside: where they are, what they see, and whom they follow or search for.
import * as three from './three.js';
import {cameraFlag} from './protocol.js';
import {dashesOf, maxDashes} from './searches.js';

const depth = 1.1;  // m, of a camera's frustum
const fillOpacity = 0.35;
const dashLength = 0.5;  // m
const rim = [[1, 1], [-1, 1], [-1, -1], [1, -1]];

const vertexShader = `
    attribute vec4 tint;
    varying vec4 paint;
    void main() {
        paint = tint;
        gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
    }`;
const fragmentShader = `
    varying vec4 paint;
    void main() { gl_FragColor = paint; }`;

// Corners of lines or triangles with their colours, written anew for each sample.
class Strokes {
    // `options`: of the material.
    constructor(Type, options = {}) {
        this.object = new Type(new three.BufferGeometry(),
            new three.ShaderMaterial({vertexShader, fragmentShader, transparent: true, depthWrite: false, ...options}));
        this.object.frustumCulled = false;
        this.reserve(256);
    }

    reserve(most) {
        const {geometry} = this.object;
        geometry.dispose();
        this.most = most;
        this.places = new three.BufferAttribute(new Float32Array(3 * most), 3);
        this.tints = new three.BufferAttribute(new Float32Array(4 * most), 4);
        geometry.setAttribute('position', this.places);
        geometry.setAttribute('tint', this.tints);
    }

    begin(most) {
        if (most > this.most) this.reserve(2 * most);
        this.count = 0;
    }

    add(place, colour, opacity) {
        this.places.setXYZ(this.count, place.x, place.y, place.z);
        this.tints.setXYZW(this.count++, colour.r, colour.g, colour.b, opacity);
    }

    end() {
        this.object.geometry.setDrawRange(0, this.count);
        this.object.visible = this.count > 0;
        this.places.needsUpdate = this.tints.needsUpdate = true;
    }
}

export class Marks {
    constructor() {
        this.lines = new Strokes(three.LineSegments);
        this.fill = new Strokes(three.Mesh, {side: three.DoubleSide});
        this.searches = new Strokes(three.LineSegments, {depthTest: false});  // walls are between camera and player
        this.group = new three.Group();
        this.group.add(this.lines.object, this.fill.object, this.searches.object);
    }

    // `looks(slot)`: {colour}.
    setLooks(looks) {
        this.looks = looks;
    }

    // Of a sample, in which the viewer has chosen a camera; `searches`: searchesOf it; metre: in map units.
    show({cameras, players}, chosen, searches, metre) {
        this.lines.begin(18 * cameras.size);
        this.fill.begin(12);
        for (const camera of cameras.values()) {
            this.addFrustum(camera, camera.id === chosen, metre);
            const followed = players.get(camera.target);
            if (followed && !searches.has(camera.id)) this.addSight(camera, followed);
        }
        this.lines.end();
        this.fill.end();
        this.searches.begin(2 * maxDashes * searches.size);
        for (const [id, searched] of searches) this.addSearch(cameras.get(id), searched, metre);
        this.searches.end();
    }

    addFrustum({target, position, rotation, fov}, chosen, metre) {
        const colour = new three.Color(this.looks(target).colour);
        const at = new three.Vector3(...position);
        const turn = new three.Quaternion(...rotation);
        const up = Math.tan(fov / 2);
        const corners = rim.map(([y, z]) =>
            new three.Vector3(1, y * up * 16 / 9, z * up).multiplyScalar(depth * metre).applyQuaternion(turn).add(at));
        corners.forEach((corner, i) => {
            const next = corners[(i + 1) % corners.length];
            for (const place of [at, corner, corner, next]) this.lines.add(place, colour, 1);
            if (chosen) for (const place of [at, corner, next]) this.fill.add(place, colour, fillOpacity);
        });
    }

    addSight({target, flags, position}, followed) {
        const colour = new three.Color(this.looks(target).colour);
        const opacity = flags & cameraFlag.visible ? 0.6 : 0.2;
        this.lines.add(new three.Vector3(...position), colour, opacity);
        this.lines.add(new three.Vector3(...followed.position), colour, opacity);
    }

    addSearch({target, position}, searched, metre) {
        const colour = new three.Color(this.looks(target).colour);
        const from = new three.Vector3(...position);
        const to = new three.Vector3(...searched.position);
        for (const ends of dashesOf(position, searched.position, dashLength * metre))
            for (const part of ends) this.searches.add(new three.Vector3().lerpVectors(from, to, part), colour, 1);
    }
}
