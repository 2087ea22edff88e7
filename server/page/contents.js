// What a server says of what is in a map, /map/MAP/contents.json and the movers of a stream (idl/live.md), is checked before
// it is believed.

const version = 1;

const isListOf = (isGood, length) => list =>
    Array.isArray(list) && (length === undefined || list.length === length) && list.every(isGood);
const isPlace = isListOf(Number.isFinite, 3);
const arePlanes = isListOf(isListOf(Number.isFinite, 4));  // or balls

const areFixedCameras = isListOf(camera =>
    isPlace(camera?.position) && (camera.spawn_point === null || Number.isFinite(camera.spawn_point)));
export const areMovers = isListOf(mover => isListOf(arePlanes)(mover?.hulls) && arePlanes(mover.balls));

export const noContents = {fixed_cameras: [], movers: []};

// Of a file's bytes. What cannot be read is nothing: the map can be seen without.
export function readContents(file) {
    try {
        const contents = JSON.parse(new TextDecoder().decode(file));
        const isGood = contents.version === version && areFixedCameras(contents.fixed_cameras) && areMovers(contents.movers);
        return isGood ? contents : noContents;
    } catch {
        return noContents;
    }
}
