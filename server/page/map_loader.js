// Loads the map of the match that is watched: what is in it, obstacles where the server has them, and the medial mesh.
import {noContents, readContents} from './contents.js';

const firstRetryMs = 3000;
const longestRetryMs = 60e3;

function noteOf(obstacles, mesh) {
    if (obstacles.file && mesh.file) return '';
    if (obstacles.file) return `The free space of this map cannot be shown: ${mesh.reason}.`;
    return mesh.file ? `Only the free space of this map can be shown: ${obstacles.reason}.`
        : `This map cannot be shown: ${mesh.reason}.`;
}

export class MapLoader {
    // `stage`: {map: MapView}. `fetchModel(map, file)`: resolves to {file} or {file: null, reason}. `now()`: ms.
    // `on.contents(contents)`: of /map/MAP/contents.json, none as loading begins.
    // `on.obstacles(hasObstacles)`: the map has them or none; `on.loaded(hasObstacles)`: `note` says what is missing.
    constructor(stage, fetchModel, now, on) {
        Object.assign(this, {stage, fetchModel, now, on});
        this.shown = null;  // the map's name; null: what is missing is to be asked for again
        this.loads = 0;     // that were begun: the last one counts
        this.retry = {of: null, at: 0, waitMs: firstRetryMs};
        this.note = '';
    }

    // A map that is shown is not loaded again, what of one could not be is later, after waits that grow.
    async load(name) {
        const {retry} = this;
        if (this.shown === name || retry.of === name && this.now() < retry.at) return;
        if (retry.of !== name) this.begin();
        this.shown = name;
        const waitMs = retry.of === name ? retry.waitMs : firstRetryMs;
        this.retry = {of: name, at: this.now() + waitMs, waitMs: Math.min(2 * waitMs, longestRetryMs)};
        const load = ++this.loads;
        const isWanted = () => load === this.loads;
        try {
            for (const [file, take] of Object.entries(this.files)) {
                if (this.found[file]) continue;
                const answer = await this.fetchModel(name, file);
                if (!isWanted()) return;
                this.found[file] = answer;
                take(answer);
            }
            this.finish();
        } catch {
            if (isWanted()) this.shown = null;
        }
    }

    begin() {
        this.found = {};  // the answers that have come, by file
        this.note = '';
        this.stage.map.clear();
        this.on.contents(noContents);
    }

    // What is done with the answers, in the order in which they are asked for.
    files = {
        'contents.json': ({file}) => {
            if (file) this.on.contents(readContents(file));
        },
        'obstacles.glb': ({file}) => {
            if (file) this.read('obstacles.glb', () => this.stage.map.setObstacles(file));
            this.on.obstacles(Boolean(this.found['obstacles.glb'].file));
        },
        'mesh.glb': ({file}) => {
            if (file) this.read('mesh.glb', () => this.stage.map.setMesh(file));
        },
    };

    read(name, show) {
        try {
            show();
        } catch {
            this.found[name] = {file: null, reason: `${name} cannot be read`};
        }
    }

    finish() {
        const {'obstacles.glb': obstacles, 'mesh.glb': mesh} = this.found;
        this.note = noteOf(obstacles, mesh);
        if (!mesh.file && !obstacles.file) {
            this.found = {};  // the server may be loading it still
            this.shown = null;
        }
        this.on.loaded(Boolean(obstacles.file));
    }
}
