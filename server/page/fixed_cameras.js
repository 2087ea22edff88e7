// The map's fixed cameras, which a match's cameras are known to be by their places.

const reach = 1;  // map unit: places in the stream are rounded

// `fixedCameras`: of /map/MAP/contents.json. `position`: of a camera, where it is known.
export function nameOfFixed(fixedCameras, position) {
    if (!position || fixedCameras.length === 0) return 'fixed camera';
    const distances = fixedCameras.map(camera => Math.hypot(...camera.position.map((value, axis) => value - position[axis])));
    const number = distances.indexOf(Math.min(...distances));
    if (distances[number] >= reach) return 'fixed camera';
    const {spawn_point: spawnPoint} = fixedCameras[number];
    return `fixed camera ${number}${spawnPoint === null ? '' : `, near spawn point ${spawnPoint}`}`;
}
