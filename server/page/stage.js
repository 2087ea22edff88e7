// What is drawn: the map, players, cameras and their frusta, from any viewpoint.
import * as three from './three.js';
import {cameraFlag, playerFlag} from './protocol.js';
import {featureEdges, readMesh} from './glb.js';

const background = 0x0d1014;
const frustumDepth = 1.1;     // m
const labelHeight = 0.030;    // of the view's height

// From a camera's axes in the match, x forward and z up, to three's: -z forward, y up.
const cameraAxes = new three.Quaternion().setFromRotationMatrix(new three.Matrix4().makeBasis(
    new three.Vector3(0, -1, 0), new three.Vector3(0, 0, 1), new three.Vector3(-1, 0, 0)));

const mapVertexShader = `
    varying vec3 place;
    void main() {
        place = (modelMatrix * vec4(position, 1.0)).xyz;
        gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
    }`;
// Flat shading from the surface's own direction: a light from above, one from the side, a sky; darker with distance.
// Fine lines every 2 m show how surfaces run and how fast a camera moves.
const mapFragmentShader = `
    varying vec3 place;
    uniform float cut;
    uniform float fade;
    uniform vec2 heights;
    uniform vec3 ground;
    uniform float metre;
    uniform float grid;
    float line(float along) {
        float cells = along / (2.0 * metre);
        float width = fwidth(cells);
        float near = abs(fract(cells - 0.5) - 0.5);
        return (1.0 - smoothstep(width, 2.0 * width, near)) * clamp(1.0 - 6.0 * width, 0.0, 1.0);
    }
    void main() {
        if (place.z > cut) discard;
        vec3 normal = normalize(cross(dFdx(place), dFdy(place)));
        float sun = max(dot(normal, normalize(vec3(0.45, 0.25, 0.85))), 0.0);
        float side = max(dot(normal, normalize(vec3(-0.7, 0.6, 0.1))), 0.0);
        float light = 0.34 + 0.12 * normal.z + 0.40 * sun + 0.22 * side;
        float height = clamp((place.z - heights.x) / max(heights.y - heights.x, 1.0), 0.0, 1.0);
        vec3 paint = mix(vec3(0.40, 0.50, 0.62), vec3(0.80, 0.76, 0.68), height);
        vec3 flatness = 1.0 - smoothstep(0.7, 0.95, abs(normal));
        float lines = max(max(line(place.x) * flatness.x, line(place.y) * flatness.y), line(place.z) * flatness.z);
        paint *= 1.0 - grid * lines;
        float far = exp(-length(place - cameraPosition) * fade);
        gl_FragColor = vec4(mix(ground, paint * light, 0.15 + 0.85 * far), 1.0);
    }`;

function labelTexture(text, colour) {
    const canvas = document.createElement('canvas');
    const context = canvas.getContext('2d');
    const font = '600 40px system-ui, sans-serif';
    context.font = font;
    canvas.width = Math.ceil(context.measureText(text).width) + 44;
    canvas.height = 60;
    context.font = font;
    context.textBaseline = 'middle';
    context.fillStyle = 'rgba(9, 12, 16, 0.72)';
    context.beginPath();
    context.arc(30, 30, 30, Math.PI / 2, Math.PI * 3 / 2);
    context.arc(canvas.width - 30, 30, 30, -Math.PI / 2, Math.PI / 2);
    context.fill();
    context.fillStyle = colour;
    context.fillText(text, 22, 32);
    const texture = new three.CanvasTexture(canvas);
    texture.minFilter = three.LinearFilter;
    return {texture, aspect: canvas.width / canvas.height};
}

// A pawn of 1 m radius 0.28 whose eye is at the origin.
function pawnGeometry() {
    const profile = [[0, -1.3], [0.3, -1.3], [0.3, -1.22], [0.2, -1.0], [0.17, -0.5], [0.24, -0.28], [0.13, -0.2],
        [0.18, -0.1], [0.2, 0], [0.18, 0.1], [0.1, 0.18], [0, 0.21]];
    const geometry = new three.LatheBufferGeometry(profile.map(([r, z]) => new three.Vector2(r, z)), 20);
    geometry.rotateX(Math.PI / 2);  // from y up to z up
    return geometry;
}

export class Stage {
    constructor(canvas) {
        this.renderer = new three.WebGLRenderer({canvas, antialias: true, powerPreference: 'high-performance'});
        this.renderer.setClearColor(background);
        this.renderer.autoClear = false;
        this.scene = new three.Scene();
        const sky = new three.HemisphereLight(0xffffff, 0x4a525d, 0.78);
        sky.position.set(0, 0, 1);
        const sun = new three.DirectionalLight(0xffffff, 0.34);
        sun.position.set(0.45, 0.25, 0.85);
        this.scene.add(sky, sun);
        this.world = new three.Group();   // the map
        this.marks = new three.Group();   // cameras and their frusta
        this.people = new three.Group();
        this.scene.add(this.world, this.marks, this.people);
        this.pawn = pawnGeometry();
        this.visor = new three.BoxBufferGeometry(0.26, 0.26, 0.09);
        this.visor.translate(0.14, 0, 0.02);
        this.players = new Map();
        this.cameras = new Map();
        this.eye = new three.PerspectiveCamera(60, 1, 1, 10000);
        this.flat = new three.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
        this.cut = 1e9;
        this.setScale(0.0254);
        this.clearMap();
    }

    setScale(metresPerUnit) {
        this.metre = 1 / (metresPerUnit > 0 ? metresPerUnit : 0.0254);
    }

    clearMap() {
        for (const child of [...this.world.children]) {
            child.geometry.dispose();
            this.world.remove(child);
        }
        this.obstacles = this.edges = this.mesh = null;
        this.bounds = null;
    }

    get hasMap() { return this.bounds !== null; }

    extend(geometry) {
        geometry.computeBoundingBox();
        this.bounds = (this.bounds ?? new three.Box3()).union(geometry.boundingBox);
    }

    setObstacles(file) {
        const data = readMesh(file, 'obstacles');
        const geometry = new three.BufferGeometry();
        geometry.setAttribute('position', new three.BufferAttribute(data.positions, 3));
        geometry.setIndex(new three.BufferAttribute(data.indices, 1));
        this.extend(geometry);
        const {min, max} = this.bounds;
        this.paint = new three.ShaderMaterial({
            vertexShader: mapVertexShader, fragmentShader: mapFragmentShader, side: three.FrontSide,
            extensions: {derivatives: true}, polygonOffset: true, polygonOffsetFactor: 1, polygonOffsetUnits: 1,
            uniforms: {
                cut: {value: max.z + 1}, fade: {value: 0}, heights: {value: new three.Vector2(min.z, max.z)},
                ground: {value: new three.Color(background)}, metre: {value: this.metre}, grid: {value: 0},
            },
        });
        this.obstacles = new three.Mesh(geometry, this.paint);
        const lines = new three.BufferGeometry();
        lines.setAttribute('position', geometry.getAttribute('position'));
        lines.setIndex(new three.BufferAttribute(featureEdges(data), 1));
        this.linePaint = new three.LineBasicMaterial({color: 0x9fb2c8, transparent: true, opacity: 0.22});
        this.linePaint.clippingPlanes = [new three.Plane(new three.Vector3(0, 0, -1), max.z + 1)];
        this.edges = new three.LineSegments(lines, this.linePaint);
        this.world.add(this.obstacles, this.edges);
    }

    setMesh(file) {
        const data = readMesh(file, 'medial mesh');
        if (!data) return;
        const geometry = new three.BufferGeometry();
        geometry.setAttribute('position', new three.BufferAttribute(data.positions, 3));
        geometry.setAttribute('color', new three.BufferAttribute(new Uint8Array(data.colours), 4, true));
        geometry.setIndex(new three.BufferAttribute(data.indices, 1));
        this.extend(geometry);
        this.meshPaint = new three.MeshBasicMaterial({
            vertexColors: three.VertexColors, side: three.DoubleSide, transparent: true, opacity: 0.38, depthWrite: false,
        });
        this.mesh = new three.Mesh(geometry, this.meshPaint);
        this.world.add(this.mesh);
    }

    // Height range of the map, for the cut.
    get heights() {
        return this.bounds ? [this.bounds.min.z, this.bounds.max.z] : [0, 1];
    }

    // `looks`: by slot {colour, label}; the players' names and colours have changed.
    setLooks(looks) {
        this.looks = looks;
        for (const entry of this.players.values()) this.removePlayer(entry);
        this.players.clear();
        for (const entry of this.cameras.values()) this.removeCamera(entry);
        this.cameras.clear();
    }

    removePlayer({group, label}) {
        label.material.map.dispose();
        this.people.remove(group, label);
    }

    removeCamera({lines, ray, fill}) {
        for (const object of [lines, ray, fill]) {
            object.geometry.dispose();
            object.material.dispose();
            this.marks.remove(object);
        }
    }

    playerOf(slot) {
        let entry = this.players.get(slot);
        if (entry) return entry;
        const {colour, label: text} = this.looks(slot);
        const body = new three.MeshLambertMaterial({color: colour});
        const face = new three.MeshLambertMaterial({color: 0x10141a});
        const group = new three.Group();
        const visor = new three.Mesh(this.visor, face);
        group.add(new three.Mesh(this.pawn, body), visor);
        const {texture, aspect} = labelTexture(text, colour);
        const label = new three.Sprite(new three.SpriteMaterial({map: texture, sizeAttenuation: false}));
        label.center.set(0.5, -0.2);
        this.people.add(group, label);
        entry = {group, visor, label, aspect};
        this.players.set(slot, entry);
        return entry;
    }

    cameraOf(id, slot) {
        let entry = this.cameras.get(id);
        if (entry?.slot === slot) return entry;
        if (entry) this.removeCamera(entry);
        const {colour} = this.looks(slot);
        const corners = new three.BufferGeometry();
        corners.setAttribute('position', new three.BufferAttribute(new Float32Array(16 * 3), 3));
        const lines = new three.LineSegments(corners, new three.LineBasicMaterial({color: colour}));
        const ends = new three.BufferGeometry();
        ends.setAttribute('position', new three.BufferAttribute(new Float32Array(2 * 3), 3));
        const ray = new three.Line(ends, new three.LineBasicMaterial({color: colour, transparent: true, opacity: 0.45}));
        const sides = new three.BufferGeometry();
        sides.setAttribute('position', corners.getAttribute('position'));
        sides.setIndex([0, 1, 3, 4, 5, 7, 8, 9, 11, 12, 13, 15]);
        const fill = new three.Mesh(sides, new three.MeshBasicMaterial({color: colour, side: three.DoubleSide,
            transparent: true, opacity: 0.35, depthWrite: false}));
        lines.frustumCulled = ray.frustumCulled = fill.frustumCulled = false;
        this.marks.add(lines, ray, fill);
        entry = {lines, ray, fill, slot};
        this.cameras.set(id, entry);
        return entry;
    }

    // Shows a sample of the match, in which the viewer has chosen a camera.
    show(sample, chosen) {
        for (const [slot, entry] of this.players) entry.group.visible = entry.label.visible = sample.players.has(slot);
        for (const player of sample.players.values()) this.showPlayer(player);
        for (const [id, entry] of this.cameras) entry.lines.visible = entry.ray.visible = entry.fill.visible = sample.cameras.has(id);
        for (const camera of sample.cameras.values()) this.showCamera(camera, sample, camera.id === chosen);
    }

    showPlayer({slot, flags, position, rotation}) {
        const {group, visor, label} = this.playerOf(slot);
        const alive = (flags & playerFlag.alive) !== 0;
        group.visible = label.visible = (flags & playerFlag.spectator) === 0;
        group.position.set(...position);
        label.position.set(position[0], position[1], position[2] + 0.3 * this.metre);
        group.scale.set(this.metre, this.metre, this.metre * (alive ? 1 : 0.25));
        visor.visible = alive;
        const heading = new three.Vector3(1, 0, 0).applyQuaternion(new three.Quaternion(...rotation));
        group.rotation.z = Math.atan2(heading.y, heading.x);
        visor.rotation.y = -Math.atan2(heading.z, Math.hypot(heading.x, heading.y));
    }

    showCamera({id, target, flags, position, rotation, fov}, sample, chosen) {
        const {lines, ray, fill} = this.cameraOf(id, target);
        fill.visible = chosen;
        const depth = frustumDepth * this.metre;
        const up = Math.tan(fov / 2) * depth;
        const side = up * 16 / 9;
        const q = new three.Quaternion(...rotation);
        const at = new three.Vector3(...position);
        const corner = (y, z) => new three.Vector3(depth, y, z).applyQuaternion(q).add(at);
        const rim = [corner(side, up), corner(-side, up), corner(-side, -up), corner(side, -up)];
        const points = [];
        rim.forEach((point, i) => points.push(at, point, point, rim[(i + 1) % 4]));
        const array = lines.geometry.getAttribute('position');
        points.forEach((point, i) => array.setXYZ(i, point.x, point.y, point.z));
        array.needsUpdate = true;
        const followed = sample.players.get(target);
        ray.visible = followed !== undefined;
        if (!followed) return;
        const ends = ray.geometry.getAttribute('position');
        ends.setXYZ(0, ...position);
        ends.setXYZ(1, ...followed.position);
        ends.needsUpdate = true;
        ray.material.opacity = flags & cameraFlag.visible ? 0.6 : 0.2;
    }

    resize(width, height, ratio) {
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height, false);
        this.height = height;
    }

    begin() {
        this.renderer.setScissorTest(false);
        this.renderer.clear();
    }

    // Draws into a rectangle of the canvas, in CSS pixels from its top left corner.
    draw(camera, {x, y, width, height}, {inside, labels = true}) {
        const diagonal = this.bounds ? this.bounds.getSize(new three.Vector3()).length() : 100 * this.metre;
        if (this.paint) {
            this.paint.side = inside ? three.DoubleSide : three.FrontSide;
            this.paint.uniforms.fade.value = inside ? 1.1 / diagonal : 0;
            this.paint.uniforms.cut.value = inside ? 1e9 : this.cut;
            this.paint.uniforms.grid.value = inside ? 0.2 : 0;
            this.renderer.localClippingEnabled = !inside;
            this.linePaint.clippingPlanes[0].constant = this.cut;
            this.linePaint.opacity = inside ? 0.28 : 0.3;
        }
        if (this.mesh) this.meshPaint.opacity = this.obstacles ? 0.38 : 0.9;
        this.marks.visible = !inside;
        for (const {label, aspect, group} of this.players.values()) {
            label.visible = labels && group.visible;
            const size = labelHeight * (camera.isOrthographicCamera ? camera.top - camera.bottom : 1) * (inside ? 1 : 0.8);
            label.scale.set(size * aspect, size, 1);
            label.material.depthTest = inside;
            label.material.sizeAttenuation = camera.isOrthographicCamera;
        }
        const bottom = this.height - y - height;
        this.renderer.setViewport(x, bottom, width, height);
        this.renderer.setScissor(x, bottom, width, height);
        this.renderer.setScissorTest(true);
        this.renderer.clear();
        this.renderer.render(this.scene, camera);
    }

    // Through a camera of the match.
    drawThrough({position, rotation, fov}, rectangle, labels = true) {
        this.eye.position.set(...position);
        this.eye.quaternion.set(...rotation).multiply(cameraAxes);
        this.eye.fov = fov * 180 / Math.PI;
        this.lens(rectangle);
        this.draw(this.eye, rectangle, {inside: true, labels});
    }

    lens({width, height}) {
        this.eye.aspect = width / height;
        this.eye.near = 0.05 * this.metre;
        this.eye.far = 2000 * this.metre;
        this.eye.updateProjectionMatrix();
    }

    // From a free viewpoint: {yaw, pitch, distance, centre}.
    drawOrbit(view, rectangle) {
        const direction = new three.Vector3(Math.cos(view.yaw) * Math.cos(view.pitch),
            Math.sin(view.yaw) * Math.cos(view.pitch), Math.sin(view.pitch));
        this.eye.fov = 50;
        this.eye.up.set(0, 0, 1);
        this.eye.position.copy(view.centre).addScaledVector(direction, view.distance);
        this.eye.lookAt(view.centre);
        this.lens(rectangle);
        this.draw(this.eye, rectangle, {inside: false});
    }

    // From above: {centre, span}, span in map units over the rectangle's smaller side.
    drawPlan(view, rectangle) {
        const smaller = Math.min(rectangle.width, rectangle.height);
        const halfWidth = view.span / 2 * rectangle.width / smaller;
        const halfHeight = view.span / 2 * rectangle.height / smaller;
        Object.assign(this.flat, {left: -halfWidth, right: halfWidth, top: halfHeight, bottom: -halfHeight});
        this.flat.position.set(view.centre.x, view.centre.y, 0);
        this.flat.quaternion.set(0, 0, 0, 1);
        this.flat.updateProjectionMatrix();
        // Seen from so far, people would be dots. They are seen through floors.
        const [low, high] = this.heights;
        for (const {group} of this.players.values()) group.scale.multiplyScalar(2);
        for (const layer of [this.people, this.marks]) layer.position.z = 2 * (high - low);
        this.draw(this.flat, rectangle, {inside: false});
        for (const layer of [this.people, this.marks]) layer.position.z = 0;
        for (const {group} of this.players.values()) group.scale.multiplyScalar(0.5);
    }
}

export {three};
