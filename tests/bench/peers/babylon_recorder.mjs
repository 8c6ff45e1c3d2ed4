// SPDX-License-Identifier: MIT
// Babylon.js draws through engines. Its null engine draws nothing, so the effect's own objects are asked for shaders,
// defines and uniforms, in the order in which SSAO2RenderingPipeline adds its passes: estimate, horizontal blur, vertical
// blur. Its view space looks down +z.
import { Recording, seedRandom, translate } from "./recording.mjs";

const VERTEX = `attribute vec2 position;
varying vec2 vUV;
void main() { vUV = position * 0.5 + 0.5; gl_Position = vec4(position, 0.0, 1.0); }
`;

// It reads its 8 samples by numbers up to 15. WebGL takes the last one for those beyond; OpenGL leaves open what is read.
function clampSamples(source) {
    const clamped = source.replace(/sampleSphere\[(\(.*?)\](?=;)/, "sampleSphere[min($1,SAMPLES-1)]");
    if (clamped === source)
        throw new Error("ssao2's shader reads its samples otherwise than was translated");
    return clamped;
}

// Stands in for a compiled effect: keeps what it is given.
class EffectRecorder {
    constructor() {
        this.samplers = [];
        this.uniforms = [];
        const keep = (name, ...values) => this.uniforms.push([name, values.flat().map(Number)]);
        for (const call of ["setFloat", "setFloat2", "setFloat3", "setFloat4", "setInt", "setArray3"])
            this[call] = (name, ...values) => keep(name, ...values.map((v) => Array.from(v?.length ? v : [v])));
        this.setMatrix3x3 = (name, matrix) => keep(name, Array.from(matrix));
        this.setMatrix = (name, matrix) => keep(name, Array.from(matrix.m));
        this.setTexture = (name, texture) => this.samplers.push([name, texture]);
        this.setVector2 = (name, v) => keep(name, [v.x, v.y]);
    }
}

export async function recordBabylon(job, load) {
    console.log = () => {};
    const at = "@babylonjs/core/";
    const { NullEngine } = await load(at + "Engines/nullEngine.js");
    const { Scene } = await load(at + "scene.js");
    const { FreeCamera } = await load(at + "Cameras/freeCamera.js");
    const { Vector3, Matrix } = await load(at + "Maths/math.vector.js");
    const { ThinSSAO2RenderingPipeline } = await load(at + "PostProcesses/RenderPipeline/Pipelines/thinSSAO2RenderingPipeline.js");
    const { ssao2PixelShader } = await load(at + "Shaders/ssao2.fragment.js");
    const { RawTexture } = await load(at + "Materials/Textures/rawTexture.js");
    let noise = null;
    const create = RawTexture.CreateRGBATexture;
    RawTexture.CreateRGBATexture = (data, width, height, ...rest) => {
        const texture = create(data, width, height, ...rest);
        noise = { texture, data, width, height };
        return texture;
    };
    const engine = new NullEngine({ renderWidth: job.width, renderHeight: job.height, textureSize: 512,
        deterministicLockstep: false, lockstepMaxSteps: 1 });
    const scene = new Scene(engine), camera = new FreeCamera("camera", Vector3.Zero(), scene);
    camera.minZ = Math.min(job.near, 0.1 * job.radius); // it shortens the radius near the camera, by minZAspect
    camera.maxZ = job.far;
    camera.fov = 2 * Math.atan(1 / job.clipFromView[5]);
    seedRandom();
    const pipeline = new ThinSSAO2RenderingPipeline("ssao", scene);
    pipeline.camera = camera;
    pipeline.radius = job.radius * job.radiusScale;
    pipeline.totalStrength = job.strength;
    pipeline.maxZ = job.thickness === 1 ? 50 * job.radius : 2 * job.far;
    pipeline.epsilon = 0.01 * job.radius * job.thickness;

    const recording = new Recording(job.folder);
    const target = (width, height) => recording.texture({}, () => ({ width, height, format: "rgba8", linear: true, repeat: false }));
    const random = recording.texture(noise.texture, () => ({ width: noise.width, height: noise.height, format: "rgba8", linear: true,
        repeat: true, data: noise.data }));
    const half = [Math.floor(job.width / 2), Math.floor(job.height / 2)], full = [job.width, job.height];
    const add = (wrapper, defines, input, size) => {
        const effect = new EffectRecorder();
        wrapper._drawWrapper.effect = effect;
        wrapper.bind(true);
        const samplers = effect.samplers.map(([name]) => [name, random]);
        samplers.push(["depthSampler", "distance"], ["normalSampler", "normals_left_handed"]);
        if (input !== null)
            samplers.push(["textureSampler", input]);
        const output = target(...size);
        recording.pass(recording.program(translate(VERTEX, false, ""), translate(clampSamples(ssao2PixelShader.shader), true, defines)), [output],
            [0, 0, ...size], samplers, effect.uniforms);
        return output;
    };
    const estimate = pipeline._ssaoPostProcess, blurX = pipeline._ssaoBlurXPostProcess, blurY = pipeline._ssaoBlurYPostProcess;
    estimate.textureWidth = job.width;
    estimate.textureHeight = job.height;
    blurX.textureSize = job.width;
    blurY.textureSize = job.height;
    let last = add(estimate, estimate._getDefinesForSSAO(), null, half);
    last = add(blurX, blurX._getDefinesForBlur(true, false), last, full);
    last = add(blurY, blurY._getDefinesForBlur(true, false), last, full);
    return recording.output(last);
}
