// How fast the window draws, by Chromium's own measures: window.mjs BIN_DIR FOLDER DOMAIN PLAYERS CAMERAS SECONDS HOLD
// [PICTURES], as bench-window.sh calls it. FOLDER has config.json and the baked map.
import {readFileSync, writeFileSync} from 'node:fs';
import {Browser} from '../integration/window/browser.mjs';
import {Programs, eventually} from '../integration/window/stage.mjs';

const [bin, folder, domain, players, cameras, seconds, hold, pictures] = process.argv.slice(2);
const url = `http://127.0.0.1:${20000 + Number(domain) * 100}`;
const sizes = [{width: 1280, height: 720}, {width: 360, height: 640}];
const views = ['camera', 'orbit', 'plan'];
const settleMs = 10e3;  // the page finds what this machine can draw
const frameCategory = 'disabled-by-default-devtools.timeline.frame';

const json = path => fetch(url + path).then(answer => answer.json());
const pause = ms => new Promise(resolve => setTimeout(resolve, ms));

// Runs in the page before its own code: when the match is first drawn with its map.
const observer = `(() => {
    const seen = window.benchWindow = {picture: null};
    const frame = at => {
        const state = window.cameraDirector?.state();
        if (state?.obstacles && state.players.length > 0 && state.cameras.length > 0) seen.picture = at;
        else requestAnimationFrame(frame);
    };
    requestAnimationFrame(frame);
})()`;

function quantile(sorted, part) {
    return sorted[Math.min(Math.floor(sorted.length * part), sorted.length - 1)];
}

// Processor time of each kind of Chromium's processes, s.
async function processorTime(browser) {
    const {processInfo} = await browser.send('SystemInfo.getProcessInfo', {}, 60e3, null);
    const sum = {};
    for (const {type, cpuTime} of processInfo) sum[type] = (sum[type] ?? 0) + cpuTime;
    return sum;
}

// When the browser's compositor has drawn a frame, in ms, while `during` goes on.
async function drawnTimes(browser, during) {
    const from = browser.events.length;
    await browser.send('Tracing.start', {transferMode: 'ReportEvents', traceConfig: {includedCategories: [frameCategory]}});
    await during();
    await browser.send('Tracing.end');
    await eventually('the trace', () => browser.events.slice(from).some(({method}) => method === 'Tracing.tracingComplete'));
    return browser.events.slice(from).filter(({method}) => method === 'Tracing.dataCollected')
        .flatMap(({params}) => params.value).filter(({name}) => name === 'DrawFrame').map(({ts}) => ts / 1000).sort((a, b) => a - b);
}

async function measure(browser) {
    let before;
    let after;
    const times = await drawnTimes(browser, async () => {
        before = await processorTime(browser);
        await pause(seconds * 1000);
        after = await processorTime(browser);
    });
    const intervals = times.slice(1).map((at, i) => at - times[i]).sort((a, b) => a - b);
    const cost = type => ((after[type] ?? 0) - (before[type] ?? 0)) * 1000 / times.length;
    return {rate: intervals.length * 1000 / (times[times.length - 1] - times[0]),
        intervals: [0.5, 0.95, 0.99].map(part => quantile(intervals, part)), costs: ['renderer', 'GPU', 'browser'].map(cost),
        quality: await browser.evaluate('cameraDirector.state().quality')};
}

const numbers = values => values.map(value => value.toFixed(1)).join(' / ');

async function measureView(browser, {width, height}, view) {
    await browser.evaluate(`document.querySelector('[data-view=${view}]').click()`);
    await pause(settleMs);
    const {rate, intervals, costs, quality} = await measure(browser);
    console.log(`| ${width}x${height} | ${view} | ${rate.toFixed(1)} | ${numbers(intervals)} | ${numbers(costs)} | ${quality} |`);
    if (pictures) writeFileSync(`${pictures}/${width}-${view}.png`, await browser.screenshot());
}

const bytesLoaded = browser => browser.events.filter(({method}) => method === 'Network.loadingFinished')
    .reduce((sum, {params}) => sum + params.encodedDataLength, 0);

async function firstPicture(browser) {
    await browser.send('Network.clearBrowserCache');
    await browser.open('about:blank');
    browser.events.length = 0;
    await browser.open(`${url}/`);
    return browser.until('window.benchWindow?.picture');
}

// Of a process, MB.
function residentMemory(pid) {
    return Number(/^VmRSS:\s+(\d+)/m.exec(readFileSync(`/proc/${pid}/status`, 'utf8'))[1]) / 1024;
}

async function memory(browser) {
    await browser.send('HeapProfiler.collectGarbage');
    const {usedSize} = await browser.send('Runtime.getHeapUsage');
    const {nodes} = await browser.send('Memory.getDOMCounters');
    const {processInfo} = await browser.send('SystemInfo.getProcessInfo', {}, 60e3, null);
    const resident = kind => processInfo.filter(({type}) => type === kind)
        .reduce((sum, {id}) => sum + residentMemory(id), 0);
    const of = ['renderer', 'GPU', 'browser'].map(kind => resident(kind).toFixed(0)).join(' / ');
    return `${(usedSize / 2 ** 20).toFixed(2)} | ${nodes} | ${of}`;
}

// What the page has, while the match goes on.
async function holdOpen(browser) {
    console.log('\n| after, s | heap after collection, MB | DOM nodes | page / GPU process / browser resident, MB |');
    console.log('|---|---|---|---|');
    for (let part = 0; part <= 10; ++part) {
        if (part > 0) await pause(hold * 100);
        browser.events.length = 0;
        console.log(`| ${(hold * part / 10).toFixed(0)} | ${await memory(browser)} |`);
    }
}

async function main() {
    const programs = new Programs(bin);
    let browser;
    try {
        programs.start('camera-director', 'serve', '--config', `${folder}/config.json`);
        programs.start('synthetic-players', `${folder}/map.vfs`, '--map-name', 'map', '--players', players,
            '--match-prefix', 'walk', '--rate', '60', '--domain', domain);
        programs.start('observer-probe', '--domain', domain, '--match-prefix', 'walk', '--observers', cameras,
            '--grace', '600', '--max-gaps', '1000000', '--max-violations', '1000000');
        await eventually('cameras', () => json('/live').then(live => live.matches[0]?.shots.length === Number(cameras)));
        browser = await Browser.start(sizes[0]);
        await browser.send('Page.addScriptToEvaluateOnNewDocument', {source: observer});
        console.log('| size | view | frames/s | interval p50 / p95 / p99, ms | page / GPU process / browser, ms a frame | level |');
        console.log('|---|---|---|---|---|---|');
        const loads = [];
        for (const size of sizes) {
            await browser.resize(size);
            const ms = await firstPicture(browser);
            for (const view of views) await measureView(browser, size, view);
            loads.push(`${size.width}x${size.height}: first picture after ${ms.toFixed(0)} ms, ${bytesLoaded(browser)} bytes loaded`);
        }
        console.log(`\n${loads.join('\n')}`);
        if (hold > 0) await holdOpen(browser);
    } catch (error) {
        console.log(error.stack, programs.logs());
        process.exitCode = 1;
    } finally {
        browser?.close();
        programs.kill();
    }
}

await main();
