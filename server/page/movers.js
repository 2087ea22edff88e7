// What moves in the map and is in the way: doors, lifts, vehicles.
import * as three from './three.js';
import {facesOf} from './convex.js';

const ballSides = 24;

function hullGeometries(hulls) {
    const corners = [];
    const ends = [];
    for (const polygon of hulls.flatMap(facesOf)) {
        for (let i = 2; i < polygon.length; ++i) corners.push(...polygon[0], ...polygon[i - 1], ...polygon[i]);
        polygon.forEach((point, i) => ends.push(...point, ...polygon[(i + 1) % polygon.length]));
    }
    return [corners, ends].map(places => {
        const geometry = new three.BufferGeometry();
        geometry.setAttribute('position', new three.BufferAttribute(new Float32Array(places), 3));
        return geometry;
    });
}

function ballGeometry([x, y, z, radius]) {
    const geometry = new three.SphereBufferGeometry(radius, ballSides, ballSides / 2);
    geometry.translate(x, y, z);
    return geometry;
}

// A mover's faces and edges, about its own origin.
function modelOf({hulls, balls}) {
    const model = new three.Group();
    const [faces, edges] = hullGeometries(hulls);
    faces.computeVertexNormals();
    for (const geometry of [faces, ...balls.map(ballGeometry)]) model.add(new three.Mesh(geometry));
    model.add(new three.LineSegments(edges));
    return model;
}

export class Movers {
    constructor() {
        this.group = new three.Group();
        this.map = [];
        this.clear();
    }

    clear() {
        for (const model of this.group.children) for (const {geometry} of model.children) geometry.dispose();
        this.group.remove(...this.group.children);
        this.models = new Map();  // by id
        this.list = null;
    }

    // `movers`: the map's, whose shapes count for those of a match that have their names.
    setMap(movers) {
        this.map = movers;
        this.clear();
    }

    // `list`: what a match has of movers; poses: by id, where they are.
    show(list, poses) {
        if (list !== this.list) this.build(list);
        for (const [id, model] of this.models) {
            const pose = poses.get(id);
            model.visible = pose !== undefined;
            if (!pose) continue;
            model.position.set(...pose.position);
            model.quaternion.set(...pose.rotation);
        }
    }

    build(list) {
        this.clear();
        this.list = list;
        for (const mover of list) {
            const known = this.map.find(({name}) => name === mover.name && name !== '');
            const model = modelOf(known ?? mover);
            this.models.set(mover.id, model);
            this.group.add(model);
        }
    }

    // Edges may be left out.
    paint([faces, edges], hasEdges) {
        for (const model of this.group.children) {
            for (const part of model.children) {
                const isFace = part instanceof three.Mesh;
                part.material = isFace ? faces : edges;
                part.visible = isFace || hasEdges;
            }
        }
    }

    // What is drawn: {id, position, corners}.
    get drawn() {
        const cornersOf = ({children}) => children.reduce((sum, {geometry}) => sum + geometry.getAttribute('position').count, 0);
        return [...this.models].filter(([, model]) => model.visible)
            .map(([id, model]) => ({id, position: model.position.toArray(), corners: cornersOf(model)}));
    }
}
