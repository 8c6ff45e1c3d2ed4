// SPDX-License-Identifier: MIT
// browser.mjs NODE_MODULES SCENE JOBS FOLDER: draws each job of a file of record.mjs with the package's own renderer and
// effect and its defaults in headless Chromium, into FOLDER/PEER.png, to show that a recording draws the same. Needs Debian's chromium.
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { spawn } from "node:child_process";
import { basename, dirname, extname, join, resolve } from "node:path";

import { readJobs } from "./jobs.mjs";
import { seedRandom } from "./recording.mjs";

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
const scene = (await new GLTFLoader().loadAsync("/scene/${basename(scene)}")).scene;
${job.peer === "babylon-ssao2" ? babylonScript : threeScript}</script>`;

const threeScript = `const passes = "/modules/three/examples/jsm/postprocessing/";
const renderer = new THREE.WebGLRenderer({ antialias: false });
renderer.setSize(job.width, job.height);
document.body.append(renderer.domElement);
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
`;

// three reads the file; Babylon.js draws its triangles in white, mirrored in z as its left-handed space asks for.
const babylonScript = `const at = "/modules/@babylonjs/core/";
const load = async (path, name) => (await import(at + path + ".js"))[name];
const Engine = await load("Engines/engine", "Engine"), Scene = await load("scene", "Scene");
const FreeCamera = await load("Cameras/freeCamera", "FreeCamera"), Vector3 = await load("Maths/math.vector", "Vector3");
const Mesh = await load("Meshes/mesh", "Mesh"), VertexData = await load("Meshes/mesh.vertexData", "VertexData");
const StandardMaterial = await load("Materials/standardMaterial", "StandardMaterial");
const { Color3, Color4 } = await import(at + "Maths/math.color.js");
const SSAO2RenderingPipeline = await load("PostProcesses/RenderPipeline/Pipelines/ssao2RenderingPipeline", "SSAO2RenderingPipeline");
await import(at + "Rendering/geometryBufferRendererSceneComponent.js");
const canvas = document.createElement("canvas");
canvas.width = job.width;
canvas.height = job.height;
document.body.append(canvas);
const engine = new Engine(canvas, false, { preserveDrawingBuffer: true });
engine.getCaps().parallelShaderCompile = undefined;
const world = new Scene(engine), white = new StandardMaterial("white", world);
world.clearColor = new Color4(1, 1, 1, 1);
white.disableLighting = true;
white.emissiveColor = new Color3(1, 1, 1);
white.backFaceCulling = false;
scene.updateMatrixWorld(true);
scene.traverse((object) => {
    if (!object.isMesh)
        return;
    const geometry = object.geometry.clone().applyMatrix4(object.matrixWorld), data = new VertexData();
    const mirrored = (name) => Array.from(geometry.attributes[name].array, (value, i) => i % 3 === 2 ? -value : value);
    data.positions = mirrored("position");
    data.normals = mirrored("normal");
    data.indices = geometry.index ? Array.from(geometry.index.array) : data.positions.slice(0, data.positions.length / 3).map((_, i) => i);
    const mesh = new Mesh("mesh", world);
    data.applyToMesh(mesh);
    mesh.material = white;
});
const c = new THREE.Matrix4().fromArray(job.viewFromWorld).invert().elements;
const mirror = (i, sign) => new Vector3(sign * c[i], sign * c[i + 1], -sign * c[i + 2]);
const camera = new FreeCamera("camera", mirror(12, 1), world);
camera.upVector = mirror(4, 1);
camera.setTarget(camera.position.add(mirror(8, -1)));
camera.minZ = Math.min(job.near, 0.1 * job.radius);
camera.maxZ = job.far;
camera.fov = 2 * Math.atan(1 / job.clipFromView[5]);
(${seedRandom})(); // its samples are random
const pipeline = new SSAO2RenderingPipeline("ssao", world, { ssaoRatio: 0.5, blurRatio: 1 }, [camera], true);
pipeline.radius = job.radius;
pipeline.maxZ = 50 * job.radius;
pipeline.epsilon = 0.01 * job.radius;
await world.whenReadyAsync();
for (let i = 0; i < 4; i++)
    world.render();
`;

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
        if (job.radiusScale === 1)
            await screenshot(job);
    server.close();
});
