// SPDX-License-Identifier: MIT
// browser.mjs NODE_MODULES SCENE JOBS FOLDER: draws each job of a file of record.mjs with the package's own renderer and
// effect and its defaults in headless Chromium, into FOLDER/PEER.png, to show that a recording draws the same. Needs Debian's chromium.
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { spawn } from "node:child_process";
import { basename, dirname, extname, join, resolve } from "node:path";

import { readJobs } from "./jobs.mjs";

const [modules, scene, jobs, folder] = process.argv.slice(2);
if (!folder) {
    console.error("usage: browser.mjs NODE_MODULES SCENE JOBS FOLDER");
    process.exit(2);
}
const makePage = (job) => `<!doctype html><style>body { margin: 0 } canvas { display: block }</style>
<script type="importmap">{ "imports": { "three": "/modules/three/build/three.module.js", "three/": "/modules/three/",
"postprocessing": "/modules/postprocessing/build/index.js" } }</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
const job = ${JSON.stringify(job)};
const passes = "/modules/three/examples/jsm/postprocessing/";
const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(job.width, job.height);
document.body.append(renderer.domElement);
const scene = (await new GLTFLoader().loadAsync("/scene/${basename(scene)}")).scene;
const world = new THREE.Scene();
world.add(scene);
const camera = new THREE.PerspectiveCamera(50, job.width / job.height, job.near, job.far);
camera.matrixAutoUpdate = false;
camera.matrix.fromArray(job.viewFromWorld).invert();
camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
camera.fov = 2 * Math.atan(1 / job.clipFromView[5]) * 180 / Math.PI;
camera.updateProjectionMatrix();
camera.updateMatrixWorld(true);
const read = new THREE.WebGLRenderTarget(job.width, job.height), write = read.clone();
let pass;
if (job.peer === "three-gtao") {
    const { GTAOPass } = await import(passes + "GTAOPass.js");
    pass = new GTAOPass(world, camera, job.width, job.height);
    pass.setSize(job.width, job.height);
    pass.updateGtaoMaterial({ radius: job.radius, thickness: 4 * job.radius });
    pass.output = GTAOPass.OUTPUT.Denoise;
} else if (job.peer === "three-ssao") {
    const { SSAOPass } = await import(passes + "SSAOPass.js");
    pass = new SSAOPass(world, camera, job.width, job.height);
    pass.setSize(job.width, job.height);
    pass.kernelRadius = job.radius;
    pass.output = SSAOPass.OUTPUT.Blur;
} else if (job.peer === "three-sao") {
    const { SAOPass } = await import(passes + "SAOPass.js");
    pass = new SAOPass(world, camera, new THREE.Vector2(job.width, job.height));
    pass.setSize(job.width, job.height);
    pass.params.output = SAOPass.OUTPUT.SAO;
} else if (job.peer === "n8ao") {
    const { N8AOPass } = await import("/modules/n8ao/dist/N8AO.js");
    pass = new N8AOPass(world, camera, job.width, job.height);
    pass.configuration.aoRadius = job.radius;
    pass.configuration.gammaCorrection = false;
    pass.setDisplayMode("AO");
    pass.setSize(job.width, job.height);
}
else if (job.peer === "postprocessing-ssao") {
    const { EffectComposer, RenderPass, NormalPass, EffectPass, SSAOEffect } = await import("postprocessing");
    const white = new THREE.MeshBasicMaterial();
    world.traverse((object) => { if (object.isMesh) object.material = white; });
    world.background = new THREE.Color(1, 1, 1);
    renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
    const composer = new EffectComposer(renderer, { frameBufferType: THREE.HalfFloatType });
    const normals = new NormalPass(world, camera);
    composer.addPass(new RenderPass(world, camera));
    composer.addPass(normals);
    composer.addPass(new EffectPass(camera, new SSAOEffect(camera, normals.texture, { luminanceInfluence: 0 })));
    composer.setSize(job.width, job.height);
    pass = { render: () => composer.render(0) };
}
// SSAOPass and SAOPass draw their output into the buffer that they read: null is the screen.
pass.renderToScreen = true;
pass.render(renderer, null, pass.constructor.name === "SSAOPass" ? null : read);
</script>`;

const types = { ".js": "text/javascript", ".mjs": "text/javascript", ".html": "text/html", ".json": "application/json" };
let page = "";
const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, "http://localhost").pathname);
    try {
        const [, root, ...rest] = path.split("/");
        const from = { modules: resolve(modules), scene: dirname(resolve(scene)) }[root];
        const body = path === "/" ? page : readFileSync(join(from, ...rest));
        response.writeHead(200, { "content-type": path === "/" ? "text/html" : types[extname(path)] ?? "application/octet-stream" });
        response.end(body);
    } catch {
        response.writeHead(404).end();
    }
});

function screenshot(job) {
    const url = `http://127.0.0.1:${server.address().port}/`, out = resolve(folder, job.peer + ".png");
    page = makePage(job);
    return new Promise((done) => {
        const chromium = spawn("chromium", ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
            "--hide-scrollbars", `--window-size=${job.width},${job.height}`, "--virtual-time-budget=60000", "--enable-logging=stderr",
            `--screenshot=${out}`, url], { stdio: ["ignore", "ignore", "pipe"], timeout: 300000 });
        chromium.stderr.on("data", (text) => String(text).split("\n").filter((line) => line.includes("CONSOLE"))
            .forEach((line) => console.error(line)));
        chromium.on("close", done);
    });
}

server.listen(0, "127.0.0.1", async () => {
    for (const job of readJobs(jobs))
        // Babylon.js would need a loader of its own.
        if (job.peer !== "babylon-ssao2" && job.radiusScale === 1)
            await screenshot(job);
    server.close();
});
