// What the tests of the window have in common: the programs that they start, and a hall.
import {spawn} from 'node:child_process';
import {once} from 'node:events';

const patienceMs = 90e3;

// Programs of a folder, which end with the test.
export class Programs {
    constructor(bin) {
        this.bin = bin;
        this.children = [];
    }

    // `name`: of the folder, or a path.
    start(name, ...args) {
        const child = spawn(name.includes('/') ? name : `${this.bin}/${name}`, args, {stdio: ['ignore', 'ignore', 'pipe']});
        child.log = '';
        child.stderr.setEncoding('utf8').on('data', text => { child.log = (child.log + text).slice(-1e5); });
        this.children.push(child);
        return child;
    }

    logs() {
        return this.children.map(child => child.log).join('\n---\n');
    }

    kill() {
        for (const child of this.children) child.kill('SIGKILL');
    }
}

export async function stop(child) {
    if (child.exitCode !== null || child.signalCode !== null) return;
    child.kill('SIGTERM');
    await once(child, 'exit');
}

export async function eventually(what, condition) {
    for (const end = Date.now() + patienceMs;;) {
        const value = await Promise.resolve().then(condition).catch(() => null);
        if (value) return value;
        if (Date.now() > end) throw new Error(`never: ${what}`);
        await new Promise(resolve => setTimeout(resolve, 100));
    }
}

// A hall with two pillars, in metres, as OBJ.
export function hall() {
    const vertices = [];
    const faces = [];
    const box = ([x0, y0, z0], [x1, y1, z1], inward) => {
        const first = vertices.length + 1;
        for (const z of [z0, z1]) vertices.push([x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]);
        for (const face of [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]])
            faces.push((inward ? face : face.slice().reverse()).map(corner => corner + first));
    };
    box([0, 0, 0], [16, 10, 5], true);
    box([4, 4, 0], [5.5, 6, 5], false);
    box([10, 3, 0], [11.5, 6, 5], false);
    return vertices.map(v => `v ${v.join(' ')}\n`).join('') + faces.map(f => `f ${f.join(' ')}\n`).join('');
}

export function isInHall({position: [x, y, z]}) {
    return x > 0 && x < 16 && y > 0 && y < 10 && z > 0 && z < 5;
}

// Runs the tests in one browser, one after the other; returns how many failed.
export async function run(tests, browser, ...more) {
    let failed = 0;
    for (const [name, test] of Object.entries(tests)) {
        try {
            await test(browser, ...more);
            console.log(`ok: ${name}`);
        } catch (error) {
            ++failed;
            console.log(`FAILED: ${name}\n${error.stack}`);
            console.log(await browser.evaluate('JSON.stringify(window.cameraDirector?.state())').catch(String));
        }
    }
    return failed;
}

// How many colours a small copy of the canvas has.
export const colours = `new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(() => {
    const copy = document.createElement('canvas');
    copy.width = copy.height = 64;
    const context = copy.getContext('2d');
    cameraDirector.redraw();
    context.drawImage(document.getElementById('canvas'), 0, 0, 64, 64);
    resolve(new Set(new Uint32Array(context.getImageData(0, 0, 64, 64).data.buffer)).size);
})))`;
