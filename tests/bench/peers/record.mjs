// SPDX-License-Identifier: MIT
// record.mjs NODE_MODULES JOBS FOLDER: for each job writes FOLDER/KEY.peer, the passes of one peer for one view.
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { readJobs } from "./jobs.mjs";
import { peers } from "./peers.mjs";
import { seedRandom } from "./recording.mjs";

const [modules, jobs, folder] = process.argv.slice(2);
if (!folder) {
    console.error("usage: record.mjs NODE_MODULES JOBS FOLDER");
    process.exit(2);
}
const load = (path) => import(pathToFileURL(join(resolve(modules), path)));
for (const job of readJobs(jobs)) {
    try {
        seedRandom();
        (await peers[job.peer]({ ...job, folder }, load)).write(join(folder, job.key + ".peer"));
    } catch (fault) {
        console.error(`${job.peer}: ${fault.stack}`);
        process.exit(1);
    }
}
