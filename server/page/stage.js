// What is drawn: the map, players, cameras and their frusta, from any viewpoint.
import * as three from './three.js';
import {Figures} from './figures.js';
import {MapView, background} from './map_view.js';
import {Marks} from './marks.js';
import {Movers} from './movers.js';
import {SmallPictures} from './small_pictures.js';
import {StillMap} from './still_map.js';

// From a camera's axes in the match, x forward and z up, to three's: -z forward, y up.
const cameraAxes = new three.Quaternion().setFromRotationMatrix(new three.Matrix4().makeBasis(
    new three.Vector3(0, -1, 0), new three.Vector3(0, 0, 1), new three.Vector3(-1, 0, 0)));
// Seen from so far, people would be dots.
const planTimes = 2;

const drawsByProcessor = /swiftshader|llvmpipe|softpipe|software|basic render/i;

// Whether the browser draws with a graphics card. Smooth edges are too much for a processor.
function findCard() {
    const context = document.createElement('canvas').getContext('webgl', {failIfMajorPerformanceCaveat: true});
    if (!context) return false;
    const info = context.getExtension('WEBGL_debug_renderer_info');
    const name = context.getParameter(info ? info.UNMASKED_RENDERER_WEBGL : context.RENDERER);
    context.getExtension('WEBGL_lose_context')?.loseContext();
    return !drawsByProcessor.test(name);
}

export class Stage {
    constructor(canvas) {
        this.hasCard = findCard();
        this.renderer = new three.WebGLRenderer({canvas, antialias: this.hasCard, powerPreference: 'high-performance'});
        this.renderer.setClearColor(background);
        this.renderer.autoClear = false;
        this.map = new MapView();
        this.figures = new Figures(this.hasCard ? 20 : 8);
        this.marks = new Marks();
        this.movers = new Movers();
        this.scene = new three.Scene();
        this.scene.add(this.map.group, this.movers.group, this.marks.group, this.figures.group);
        this.stillMap = new StillMap(this.renderer);
        this.pictures = new SmallPictures(this.renderer, this.hasCard ? 2 : 1);
        this.eye = new three.PerspectiveCamera(60, 1, 1, 10000);
        this.flat = new three.OrthographicCamera(-1, 1, 1, -1, -1e5, 1e5);
        this.cut = 1e9;
        this.sample = null;
        this.setScale(0.0254);
    }

    setScale(metresPerUnit) {
        this.metre = 1 / (metresPerUnit > 0 ? metresPerUnit : 0.0254);
        this.map.setScale(this.metre);
    }

    // `looks`: by slot {colour, label}; the players' names and colours have changed.
    setLooks(looks) {
        this.figures.setLooks(looks);
        this.marks.setLooks(looks);
        this.sample = null;
    }

    // Of the match that was shown nothing is drawn any more.
    forget() {
        this.sample = null;
        this.figures.forget();
        this.movers.clear();
    }

    // From now on a sample of the match is drawn, in which the viewer has chosen a camera. `searches`: searchesOf it.
    show(sample, chosen, searches) {
        Object.assign(this, {sample, chosen, searches});
        this.figures.show(sample.players, this.metre);
        this.movers.show(sample.moverList, sample.movers);
    }

    // ratio: pixels of the canvas for each of the page.
    resize(width, height, ratio) {
        this.renderer.setPixelRatio(ratio);
        this.renderer.setSize(width, height, false);
        this.whole = {width, height, ratio};
    }

    // Through a camera of the match.
    drawThrough(shot) {
        this.aim(shot, this.whole);
        this.draw(this.eye, this.whole, {inside: true, namesHidden: true});
    }

    // Draws small picture i, of this size in pixels of the page, through a camera, where it is due or was of another camera.
    drawSmall(i, shot, size, isDue) {
        const [width, height] = [size.width, size.height].map(length => Math.round(length * this.whole.ratio));
        if (!isDue && this.pictures.shows(i, shot.id, width, height)) return;
        this.pictures.draw(i, shot.id, width, height, () => {
            this.aim(shot, size);
            this.draw(this.eye, {...size, ratio: this.whole.ratio}, {inside: true, names: false});
        });
    }

    // Puts small picture i into a rectangle of the canvas, in pixels of the page from its top left corner.
    pasteSmall(i, {x, y, width, height}) {
        this.renderer.setViewport(x, this.whole.height - y - height, width, height);
        this.pictures.paste(i);
        this.renderer.setViewport(0, 0, this.whole.width, this.whole.height);
    }

    // From a free viewpoint: {yaw, pitch, distance, centre}.
    drawOrbit(view) {
        const direction = new three.Vector3(Math.cos(view.yaw) * Math.cos(view.pitch),
            Math.sin(view.yaw) * Math.cos(view.pitch), Math.sin(view.pitch));
        this.eye.fov = 50;
        this.eye.up.set(0, 0, 1);
        this.eye.position.copy(view.centre).addScaledVector(direction, view.distance);
        this.eye.lookAt(view.centre);
        this.lens(this.whole);
        this.draw(this.eye, this.whole, {inside: false});
    }

    // From above: {centre, span}, span in map units over the smaller side. People are seen through floors.
    drawPlan(view) {
        const {width, height} = this.whole;
        const smaller = Math.min(width, height);
        const halfWidth = view.span / 2 * width / smaller;
        const halfHeight = view.span / 2 * height / smaller;
        Object.assign(this.flat, {left: -halfWidth, right: halfWidth, top: halfHeight, bottom: -halfHeight});
        this.flat.position.set(view.centre.x, view.centre.y, 0);
        this.flat.quaternion.set(0, 0, 0, 1);
        this.flat.updateProjectionMatrix();
        const [low, high] = this.map.heights;
        const layers = [this.figures.group, this.marks.group];
        for (const layer of layers) layer.position.z = 2 * (high - low);
        this.draw(this.flat, this.whole, {inside: false, times: planTimes});
        for (const layer of layers) layer.position.z = 0;
    }

    aim({position, rotation, fov}, size) {
        this.eye.position.set(...position);
        this.eye.quaternion.set(...rotation).multiply(cameraAxes);
        this.eye.fov = fov * 180 / Math.PI;
        this.lens(size);
    }

    lens({width, height}) {
        this.eye.aspect = width / height;
        this.eye.near = 0.05 * this.metre;
        this.eye.far = 2000 * this.metre;
        this.eye.updateProjectionMatrix();
    }

    draw(camera, size, {inside, times = 1, names = true, namesHidden = false}) {
        this.map.show(inside, this.cut);
        this.movers.paint(this.map.moverPaint, this.map.hasEdges);
        this.marks.group.visible = !inside && this.sample !== null;
        if (this.marks.group.visible) this.marks.show(this.sample, this.chosen, this.searches, this.metre);
        this.figures.aim(camera, size, {times, names, namesHidden});
        this.renderer.clear();
        // The free space is seen through, and drawn after those who stand in it.
        if (inside || this.hasCard || this.map.mesh?.visible) this.renderer.render(this.scene, camera);
        else this.drawOverMap(camera, size);
    }

    // What moves over the map, which may stand still.
    drawOverMap(camera, {width, height, ratio}) {
        const moving = [this.figures.group, this.marks.group, this.movers.group];
        const shown = moving.map(({visible}) => visible);
        camera.updateMatrixWorld();
        const key = [...camera.matrixWorld.elements, ...camera.projectionMatrix.elements, this.map.look].join(' ');
        this.stillMap.draw(key, Math.floor(width * ratio), Math.floor(height * ratio), () => {
            for (const group of moving) group.visible = false;
            this.renderer.render(this.scene, camera);
            moving.forEach((group, i) => { group.visible = shown[i]; });
        });
        this.map.group.visible = false;
        this.renderer.render(this.scene, camera);
        this.map.group.visible = true;
    }
}

export {three};
