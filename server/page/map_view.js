// The map: its obstacles, their edges, and the medial mesh.
import * as three from './three.js';
import {clusters} from './clusters.js';
import {featureEdges, readMesh} from './glb.js';

export const background = 0x0d1014;
const clusterSize = 384;  // triangles or edges
const maxClusters = 128;
const edgeColour = 0x9fb2c8;

// A face has one light: from above, from the side, of the sky. What it needs is found at its corners: pictures have more
// pixels.
const faceVertexShader = `
    varying vec3 paint;
    uniform vec2 heights;
    #ifdef INSIDE
    varying vec2 cells;
    uniform float metre;
    #endif
    #ifdef CUT
    varying float height;
    #endif
    void main() {
        vec3 place = (modelMatrix * vec4(position, 1.0)).xyz;
        vec3 surface = normalize((modelMatrix * vec4(normal, 0.0)).xyz);
    #ifdef INSIDE
        if (dot(surface, cameraPosition - place) < 0.0) surface = -surface;
        vec3 flatness = abs(normal);
        vec3 at = LINES;
        cells = (flatness.z > max(flatness.x, flatness.y) ? at.xy : flatness.x > flatness.y ? at.yz : at.xz) / (2.0 * metre) - 0.5;
    #endif
    #ifdef CUT
        height = place.z;
    #endif
        float sun = max(dot(surface, vec3(0.451754, 0.250975, 0.853314)), 0.0);
        float side = max(dot(surface, vec3(-0.754829, 0.646996, 0.107833)), 0.0);
        float light = 0.34 + 0.12 * surface.z + 0.40 * sun + 0.22 * side;
        float part = (place.z - heights.x) / max(heights.y - heights.x, 1.0);
        paint = light * mix(LOW, HIGH, part);
        gl_Position = projectionMatrix * viewMatrix * vec4(place, 1.0);
    }`;
// Inside: darker with distance, about exp(-x); fine lines every 2 m show how surfaces run and how fast a camera moves.
const faceFragmentShader = `
    varying vec3 paint;
    #ifdef INSIDE
    varying vec2 cells;
    uniform vec3 ground;
    uniform float fade;
    #endif
    #ifdef CUT
    varying float height;
    uniform float cut;
    #endif
    void main() {
    #ifdef CUT
        if (height > cut) discard;
    #endif
    #ifdef INSIDE
        vec2 width = fwidth(cells);
        vec2 lines = clamp(2.0 - abs(fract(cells) - 0.5) / width, 0.0, 1.0) * clamp(1.0 - 6.0 * width, 0.0, 1.0);
        float w = gl_FragCoord.w;
        float near = w * w / (w * w + fade * (w + 0.5 * fade));
        gl_FragColor = vec4(mix(ground, paint * (1.0 - 0.2 * max(lines.x, lines.y)), 0.15 + 0.85 * near), 1.0);
    #else
        gl_FragColor = vec4(paint, 1.0);
    #endif
    }`;

// The colours at the lowest and the highest point, and where the lines run: with what moves.
const wall = {LOW: 'vec3(0.40, 0.50, 0.62)', HIGH: 'vec3(0.80, 0.76, 0.68)', LINES: 'place'};
const mover = {LOW: 'vec3(0.85, 0.62, 0.28)', HIGH: 'vec3(0.95, 0.74, 0.40)', LINES: 'position'};

const edgeVertexShader = `
    varying float height;
    void main() {
        vec4 place = modelMatrix * vec4(position, 1.0);
        height = place.z;
        gl_Position = projectionMatrix * viewMatrix * place;
    }`;
const edgeFragmentShader = `
    varying float height;
    uniform float cut;
    uniform vec3 colour;
    uniform float weight;
    void main() {
        #ifdef CUT
        if (height > cut) discard;
        #endif
        gl_FragColor = vec4(colour, OPACITY * weight);
    }`;

// Corners of primitives, of so many each, as objects that lie close together: what is not seen is not drawn, and what is
// near is drawn first.
function objects(Type, positions, corners, each) {
    const count = corners.length / each;
    const centres = new Float32Array(3 * count);
    for (let i = 0; i < corners.length; ++i)
        for (let axis = 0; axis < 3; ++axis) centres[3 * Math.floor(i / each) + axis] += positions[3 * corners[i] + axis] / each;
    return clusters(centres, Math.max(clusterSize, Math.ceil(count / maxClusters))).map(primitives => {
        const places = new Float32Array(primitives.length * each * 3);
        primitives.forEach((primitive, i) => {
            for (let corner = 0; corner < each; ++corner) {
                const from = 3 * corners[primitive * each + corner];
                places.set(positions.subarray(from, from + 3), 3 * (i * each + corner));
            }
        });
        const geometry = new three.BufferGeometry();
        geometry.setAttribute('position', new three.BufferAttribute(places, 3));
        geometry.computeBoundingBox();
        const centre = geometry.boundingBox.getCenter(new three.Vector3());
        geometry.translate(-centre.x, -centre.y, -centre.z);
        geometry.computeBoundingSphere();
        const object = new Type(geometry);
        object.position.copy(centre);
        return object;
    });
}

// One normal for each face, in bytes.
function addNormals({geometry}) {
    geometry.computeVertexNormals();  // nothing is shared: they are the faces'
    const {array, count} = geometry.getAttribute('normal');
    const bytes = new Int8Array(4 * count);
    for (let i = 0; i < count; ++i)
        for (let axis = 0; axis < 3; ++axis) bytes[4 * i + axis] = Math.round(127 * array[3 * i + axis]);
    geometry.setAttribute('normal', new three.BufferAttribute(bytes, 4, true));
}

export class MapView {
    constructor() {
        this.group = new three.Group();
        this.changes = 0;
        this.uniforms = {cut: {value: 0}, heights: {value: new three.Vector2()}, metre: {value: 1}, fade: {value: 0},
            ground: {value: new three.Color(background)}, colour: {value: new three.Color(edgeColour)}, weight: {value: 1}};
        const faces = (defines, side) => new three.ShaderMaterial({vertexShader: faceVertexShader, fragmentShader: faceFragmentShader,
            defines, side, uniforms: this.uniforms, extensions: {derivatives: true}, polygonOffset: true, polygonOffsetFactor: 1,
            polygonOffsetUnits: 1});
        const lines = defines => new three.ShaderMaterial({vertexShader: edgeVertexShader, fragmentShader: edgeFragmentShader, defines,
            uniforms: this.uniforms, transparent: true, depthWrite: false});
        // How faces and edges are painted: seen from inside, and from outside whole or cut.
        const paints = colours => ({
            inside: [faces({...colours, INSIDE: ''}, three.DoubleSide), lines({OPACITY: '0.28'})],
            whole: [faces(colours, three.FrontSide), lines({OPACITY: '0.3'})],
            cut: [faces({...colours, CUT: ''}, three.FrontSide), lines({OPACITY: '0.3', CUT: ''})],
        });
        this.paints = paints(wall);
        this.moverPaints = paints(mover);
        this.meshPaint = new three.MeshBasicMaterial({vertexColors: three.VertexColors, side: three.DoubleSide, transparent: true,
            depthWrite: false});
        this.clear();
    }

    clear() {
        for (const {geometry} of this.group.children) geometry.dispose();
        this.group.remove(...this.group.children);
        ++this.changes;
        this.faces = [];
        this.edges = [];
        this.mesh = null;
        this.bounds = null;  // nothing is there
    }

    get hasObstacles() { return this.faces.length > 0; }

    // metre: in map units.
    setScale(metre) {
        this.uniforms.metre.value = metre;
    }

    // `file`: glTF.
    setObstacles(file) {
        const data = readMesh(file, 'obstacles');
        const faces = objects(three.Mesh, data.positions, data.indices, 3);
        faces.forEach(addNormals);
        const edges = objects(three.LineSegments, data.positions, featureEdges(data), 2);
        Object.assign(this, {faces, edges});  // of a file that cannot be read nothing
        this.add(...this.faces, ...this.edges);
    }

    setMesh(file) {
        const data = readMesh(file, 'medial mesh');
        if (!data) return;
        const geometry = new three.BufferGeometry();
        geometry.setAttribute('position', new three.BufferAttribute(data.positions, 3));
        geometry.setAttribute('color', new three.BufferAttribute(new Uint8Array(data.colours), 4, true));
        geometry.setIndex(new three.BufferAttribute(data.indices, 1));
        this.mesh = new three.Mesh(geometry, this.meshPaint);
        this.add(this.mesh);
    }

    add(...objects) {
        this.bounds ??= new three.Box3();
        for (const object of objects) {
            this.group.add(object);
            this.bounds.expandByObject(object);
        }
        ++this.changes;
        const {min, max} = this.bounds;
        this.uniforms.heights.value.set(min.z, max.z);
        this.uniforms.fade.value = 1.1 / max.distanceTo(min);
        this.meshPaint.opacity = this.hasObstacles ? 0.38 : 0.9;
    }

    // Lowest and highest.
    get heights() {
        return this.bounds ? [this.bounds.min.z, this.bounds.max.z] : [0, 1];
    }

    // Says all that is seen of the obstacles from outside.
    get look() {
        const {cut, weight} = this.uniforms;
        return `${this.changes} ${Math.min(cut.value, this.heights[1])} ${weight.value}`;
    }

    get hasEdges() { return this.uniforms.weight.value > 0; }

    // How much edges are seen: less where a pixel is large; 0: not at all.
    setEdges(weight) {
        this.uniforms.weight.value = weight;
    }

    // How movers are painted, as the map is.
    get moverPaint() {
        return this.moverPaints[this.seen];
    }

    // To be seen through a camera, or from outside up to the height `cut`.
    show(inside, cut) {
        this.seen = inside ? 'inside' : cut < this.heights[1] ? 'cut' : 'whole';
        const [facePaint, edgePaint] = this.paints[this.seen];
        for (const face of this.faces) face.material = facePaint;
        for (const edge of this.edges) {
            edge.material = edgePaint;
            edge.visible = this.hasEdges;
        }
        this.uniforms.cut.value = cut;
    }
}
