// Reads the server's own binary glTF: meshes of one primitive, without what glTF allows beyond that.

const types = {5121: Uint8Array, 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array};
const components = {SCALAR: 1, VEC3: 3, VEC4: 4};

function accessorValues(json, binary, index) {
    const accessor = json.accessors[index];
    const view = json.bufferViews[accessor.bufferView];
    const Type = types[accessor.componentType];
    const width = components[accessor.type];
    const stride = (view.byteStride ?? width * Type.BYTES_PER_ELEMENT) / Type.BYTES_PER_ELEMENT;
    const from = binary + (view.byteOffset ?? 0);
    return {from, Type, width, stride, count: accessor.count, length: view.byteLength / Type.BYTES_PER_ELEMENT};
}

// In map units, without the root's transformation into metres.
function positions(file, json, binary, node, index) {
    const {from, Type, width, stride, count, length} = accessorValues(json, binary, index);
    const raw = new Type(file, from, length);
    const scale = node.scale ?? [1, 1, 1];
    const origin = node.translation ?? [0, 0, 0];
    const result = new Float32Array(count * 3);
    for (let i = 0; i < count; ++i)
        for (let axis = 0; axis < width; ++axis) result[3 * i + axis] = raw[stride * i + axis] * scale[axis] + origin[axis];
    return result;
}

// {positions: Float32Array, colours: Uint8Array of 4 or null, indices: Uint32Array} of the node with this name;
// null: there is none.
export function readMesh(file, name) {
    const header = new DataView(file);
    if (header.getUint32(0, true) !== 0x46546c67) throw new Error('no glTF');
    const jsonSize = header.getUint32(12, true);
    const json = JSON.parse(new TextDecoder().decode(new Uint8Array(file, 20, jsonSize)));
    const binary = 20 + jsonSize + 8;
    const node = json.nodes.find(candidate => candidate.name === name && candidate.mesh !== undefined);
    if (!node) return null;
    const primitive = json.meshes[node.mesh].primitives[0];
    const corners = accessorValues(json, binary, primitive.indices);
    const colour = primitive.attributes.COLOR_0;
    return {
        positions: positions(file, json, binary, node, primitive.attributes.POSITION),
        colours: colour === undefined ? null : new Uint8Array(file, accessorValues(json, binary, colour).from,
            accessorValues(json, binary, colour).length),
        indices: new Uint32Array(file, corners.from, corners.count),
    };
}

// Edges between faces that meet at an angle, and edges of one face: pairs of vertices. The mesh is welded.
export function featureEdges({positions: p, indices}, minAngle = 0.35) {
    const normals = new Float32Array(indices.length);
    const count = p.length / 3;  // of vertices: keys of edges, from * count + to, stay exact
    const seen = new Map();
    const edges = [];
    const minCosine = Math.cos(minAngle);
    for (let i = 0; i < indices.length; i += 3) {
        const [a, b, c] = [indices[i] * 3, indices[i + 1] * 3, indices[i + 2] * 3];
        const u = [p[b] - p[a], p[b + 1] - p[a + 1], p[b + 2] - p[a + 2]];
        const v = [p[c] - p[a], p[c + 1] - p[a + 1], p[c + 2] - p[a + 2]];
        const n = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        const length = Math.hypot(...n) || 1;
        for (let axis = 0; axis < 3; ++axis) normals[i + axis] = n[axis] / length;
        for (let side = 0; side < 3; ++side) {
            const from = indices[i + side];
            const to = indices[i + (side + 1) % 3];
            const key = Math.min(from, to) * count + Math.max(from, to);
            if (!seen.has(key)) {
                seen.set(key, i);
                continue;
            }
            const other = seen.get(key);
            seen.delete(key);
            const cosine = normals[i] * normals[other] + normals[i + 1] * normals[other + 1] +
                normals[i + 2] * normals[other + 2];
            if (cosine < minCosine) edges.push(from, to);
        }
    }
    for (const key of seen.keys()) edges.push(Math.floor(key / count), key % count);
    return new Uint32Array(edges);
}
