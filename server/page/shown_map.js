// The map that is shown: what is in it, what of it is seen, and a note of what it lacks.
import {noContents} from './contents.js';
import {nameOfFixed} from './fixed_cameras.js';
import {MapLoader} from './map_loader.js';
import * as server from './server.js';

const find = id => document.getElementById(id);

export class ShownMap {
    // `stage`: Stage, `viewpoint`: Viewpoint; `changed()`: something else is to be drawn.
    constructor(stage, viewpoint, changed) {
        Object.assign(this, {stage, viewpoint, changed});
        this.contents = noContents;
        this.loader = new MapLoader(stage, server.model, () => performance.now(), {
            contents: contents => this.takeContents(contents),
            obstacles: hasObstacles => this.takeObstacles(hasObstacles),
            loaded: hasObstacles => this.takeAll(hasObstacles),
        });
    }

    // This map from now on; where nothing of it could be had, it is asked for again.
    load(name) {
        this.loader.load(name);
    }

    get note() { return this.loader.note; }

    // Of a camera that stands still.
    nameOfCamera(position) {
        return nameOfFixed(this.contents.fixed_cameras, position);
    }

    // As the tools say it is to be seen.
    applyTools() {
        const {map} = this.stage;
        if (map.mesh) map.mesh.visible = find('mesh').checked;
        const [low, high] = map.heights;
        this.stage.cut = low + (high - low) * Number(find('cut').value) + 1;
    }

    takeContents(contents) {
        this.contents = contents;
        this.stage.movers.setMap(contents.movers);
        this.showNote();
        this.changed();
    }

    takeObstacles(hasObstacles) {
        find('mesh').checked = !hasObstacles;
        this.fitView();
    }

    takeAll(hasObstacles) {
        if (!hasObstacles) this.fitView();
        this.showNote();
        this.changed();
    }

    showNote() {
        find('map-note').textContent = this.note;
        find('map-note').hidden = this.note === '';
    }

    fitView() {
        const {bounds} = this.stage.map;
        if (bounds) this.viewpoint.fit(bounds, find('stage').clientWidth / find('stage').clientHeight);
        this.changed();
    }
}
