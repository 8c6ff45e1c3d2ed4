// SPDX-License-Identifier: MIT
// A file of jobs: one peer and one view a line, as glssao-bench writes it. Separated by tabs: key, peer, width, height,
// radius (scene units), distance (median of the view), near, far, three multipliers (of radius, thickness, strength), 16
// numbers of view_from_world and 16 of clip_from_view.
import { readFileSync } from "node:fs";

export function readJobs(path) {
    return readFileSync(path, "utf8").trim().split("\n").map((line) => {
        const [key, peer, ...rest] = line.split("\t");
        const n = rest.map(Number);
        const [width, height, radius, distance, near, far, radiusScale, thickness, strength] = n;
        return { key, peer, width, height, radius, distance, near, far, radiusScale, thickness, strength,
            viewFromWorld: n.slice(9, 25), clipFromView: n.slice(25, 41) };
    });
}
