// Moves through the match on the timeline, by pointer, touch and keys.

const keySteps = {ArrowLeft: -1000, ArrowDown: -1000, ArrowRight: 1000, ArrowUp: 1000, PageDown: -30e3, PageUp: 30e3};

// `match`: range() [first, last] of what is kept or null, axis(): a value that changes when the times do, now() what is shown
// or null, timeAt(clientX), describe(t), seek(t), goToBegin(), goLive().
export function attachScrubbing(element, tip, match) {
    let grabbed = null;  // the axis that is dragged on
    element.addEventListener('keydown', event => {
        if (match.range() === null) return;
        if (event.key in keySteps) step(keySteps[event.key]);
        else if (event.key === 'Home') match.goToBegin();
        else if (event.key === 'End') match.goLive();
        else return;
        event.preventDefault();
    });
    element.addEventListener('pointerdown', event => {
        if (match.range() === null || event.button !== 0) return;
        element.setPointerCapture(event.pointerId);
        grabbed = match.axis();
        match.seek(match.timeAt(event.clientX));
    });
    element.addEventListener('pointermove', event => {
        if (match.range() === null) return;
        const t = match.timeAt(event.clientX);
        if (event.buttons & 1 && grabbed === match.axis()) match.seek(t);
        showTip(event.clientX, match.describe(t));
    });
    for (const name of ['pointerup', 'pointercancel']) element.addEventListener(name, () => { grabbed = null; });
    element.addEventListener('pointerleave', () => { tip.hidden = true; });

    function step(ms) {
        if (match.now() !== null) match.seek(match.now() + ms);
    }

    function showTip(clientX, text) {
        const {left, width} = element.getBoundingClientRect();
        tip.textContent = text;
        tip.hidden = false;
        const half = tip.offsetWidth / 2;
        tip.style.left = `${Math.min(Math.max(clientX - left, half), width - half)}px`;
    }
}
