// Loads the map of the match that is watched: what is in it, obstacles where the server has them, and the medial mesh.

const firstRetryMs = 3000;
const longestRetryMs = 60e3;

const nothing = {fixed_cameras: [], movers: []};

function contentsOf({file}) {
    try {
        return file ? JSON.parse(new TextDecoder().decode(file)) : nothing;
    } catch {
        return nothing;  // the map can be seen without
    }
}

function noteOf(obstacles, mesh) {
    if (obstacles.file) return '';
    return mesh.file ? `Only the free space of this map can be shown: ${obstacles.reason}.`
        : `This map cannot be shown: ${mesh.reason}.`;
}

export class MapLoader {
    // `stage`: {map: MapView}. `fetchModel(map, file)`: resolves to {file} or {file: null, reason}. `now()`: ms.
    // `on.contents(contents)`: of /map/MAP/contents.json.
    // `on.obstacles(hasObstacles)`: the map has them or none; `on.loaded(hasObstacles)`: `note` says what is missing.
    constructor(stage, fetchModel, now, on) {
        Object.assign(this, {stage, fetchModel, now, on});
        this.shown = null;  // the map's name; null: it is to be asked for again
        this.retry = {of: null, at: 0, waitMs: firstRetryMs};
        this.note = '';
    }

    // A map that is shown is not loaded again, one that could not be is later, after waits that grow.
    async load(name) {
        const {retry} = this;
        if (this.shown === name || retry.of === name && this.now() < retry.at) return;
        this.shown = name;
        const waitMs = retry.of === name ? retry.waitMs : firstRetryMs;
        this.retry = {of: name, at: this.now() + waitMs, waitMs: Math.min(2 * waitMs, longestRetryMs)};
        this.stage.map.clear();
        this.on.contents(nothing);
        let obstacles;
        let mesh;
        try {
            const contents = contentsOf(await this.fetchModel(name, 'contents.json'));
            if (this.shown !== name) return;
            this.on.contents(contents);
            obstacles = await this.fetchModel(name, 'obstacles.glb');
            if (this.shown !== name) return;
            if (obstacles.file) this.stage.map.setObstacles(obstacles.file);
            this.on.obstacles(Boolean(obstacles.file));
            mesh = await this.fetchModel(name, 'mesh.glb');
        } catch {
            if (this.shown === name) this.shown = null;
            return;
        }
        if (this.shown === name) this.finish(obstacles, mesh);
    }

    finish(obstacles, mesh) {
        if (mesh.file) this.stage.map.setMesh(mesh.file);
        this.note = noteOf(obstacles, mesh);
        if (!mesh.file && !obstacles.file) this.shown = null;  // the server may be loading it still
        this.on.loaded(Boolean(obstacles.file));
    }
}
