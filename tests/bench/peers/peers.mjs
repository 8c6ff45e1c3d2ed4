// SPDX-License-Identifier: MIT
// The peers: each sets up the package's own effect for a view and lets it draw into a recorder. Lengths are scaled so that
// the documented default radius becomes the scene's; all other settings keep their documented defaults, times the
// multipliers of the job.
import { recordBabylon } from "./babylon_recorder.mjs";
import { ThreeRecorder } from "./three_recorder.mjs";

async function threeView(job, load) {
    const THREE = await load("three/build/three.module.js");
    const camera = new THREE.PerspectiveCamera(50, job.width / job.height, job.near, job.far);
    camera.matrixAutoUpdate = false;
    camera.matrixWorldInverse.fromArray(job.viewFromWorld);
    camera.matrixWorld.copy(camera.matrixWorldInverse).invert();
    camera.matrix.copy(camera.matrixWorld);
    camera.matrix.decompose(camera.position, camera.quaternion, camera.scale);
    camera.projectionMatrix.fromArray(job.clipFromView);
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
    camera.fov = 2 * Math.atan(1 / job.clipFromView[5]) * 180 / Math.PI;
    const scene = new THREE.Scene(), renderer = new ThreeRecorder(THREE, scene, job.folder, job.width, job.height);
    const target = () => new THREE.WebGLRenderTarget(job.width, job.height, { type: THREE.HalfFloatType });
    return { THREE, camera, scene, renderer, read: target(), write: target() };
}

const passes = "three/examples/jsm/postprocessing/";

export const peers = {
    // Defaults: radius 0.25, thickness 1, distanceExponent 1, scale 1, 16 samples.
    "three-gtao": async (job, load) => {
        const v = await threeView(job, load);
        const { GTAOPass } = await load(passes + "GTAOPass.js");
        const pass = new GTAOPass(v.scene, v.camera, job.width, job.height);
        pass.setSize(job.width, job.height);
        pass.updateGtaoMaterial({ radius: job.radius * job.radiusScale, thickness: 4 * job.radius * job.thickness, scale: job.strength });
        pass.output = GTAOPass.OUTPUT.Off;
        pass.render(v.renderer, v.write, v.read);
        return v.renderer.recording.output(v.renderer.texture(pass.gtaoMap));
    },
    // Defaults: kernelRadius 8, minDistance 0.005 and maxDistance 0.1 of the depth range, 32 samples.
    "three-ssao": async (job, load) => {
        const v = await threeView(job, load);
        const { SSAOPass } = await load(passes + "SSAOPass.js");
        const pass = new SSAOPass(v.scene, v.camera, job.width, job.height);
        pass.setSize(job.width, job.height);
        pass.kernelRadius = job.radius * job.radiusScale;
        if (job.thickness !== 1) { // the longest distance that counts, in radii
            pass.maxDistance = job.radius * job.thickness / (job.far - job.near);
            pass.minDistance = 0.05 * pass.maxDistance;
        }
        pass.output = SSAOPass.OUTPUT.Blur;
        pass.render(v.renderer, v.write, v.read);
        return v.renderer.recording.output(v.renderer.texture(pass.blurRenderTarget.texture));
    },
    // Defaults: saoKernelRadius 100 pixels, saoScale 1, saoIntensity 0.18, saoBias 0.5.
    "three-sao": async (job, load) => {
        const v = await threeView(job, load);
        const { SAOPass } = await load(passes + "SAOPass.js");
        const pass = new SAOPass(v.scene, v.camera, new v.THREE.Vector2(job.width, job.height));
        pass.setSize(job.width, job.height);
        const pixels = job.radius / job.distance * job.clipFromView[5] * job.height / 2;
        pass.params.saoKernelRadius = job.radiusScale === 1 ? 100 : pixels * job.radiusScale;
        if (job.thickness !== 1) { // its lengths suit a scene whose radius and far plane are 1
            pass.params.saoScale = job.far / job.radius * job.thickness;
            pass.params.saoBias *= job.radius;
            pass.params.saoIntensity *= job.strength / job.radius;
        }
        pass.params.output = SAOPass.OUTPUT.SAO;
        pass.render(v.renderer, v.write, v.read);
        return v.renderer.recording.output(v.renderer.texture(pass.saoRenderTarget.texture));
    },
    // Defaults: aoRadius 5, distanceFalloff 1, intensity 5, 16 samples, 8 denoise samples twice.
    "n8ao": async (job, load) => {
        const v = await threeView(job, load);
        const { N8AOPass } = await load("n8ao/dist/N8AO.js");
        const pass = new N8AOPass(v.scene, v.camera, job.width, job.height);
        pass.configuration.aoRadius = job.radius * job.radiusScale;
        pass.configuration.distanceFalloff = job.thickness;
        pass.configuration.intensity = 5 * job.strength;
        pass.configuration.gammaCorrection = false;
        pass.setDisplayMode("AO");
        pass.setSize(job.width, job.height);
        pass.render(v.renderer, v.write, v.read);
        return v.renderer.recording.output(v.renderer.texture(v.write.texture));
    },
    // Defaults: radius 0.1825 of the picture's height, intensity 1, bias 0.025, fade 0.01, 9 samples. The luminance of the
    // picture, which there is not, has no influence.
    "postprocessing-ssao": async (job, load) => {
        const v = await threeView(job, load);
        const { EffectComposer, RenderPass, NormalPass, EffectPass, SSAOEffect } = await load("postprocessing/build/index.js");
        const composer = new EffectComposer(v.renderer, { frameBufferType: v.THREE.HalfFloatType });
        composer.autoRenderToScreen = false;
        composer.setSize(job.width, job.height);
        const normals = new NormalPass(v.scene, v.camera);
        const height = job.radius / job.distance * job.clipFromView[5] / 2; // of the radius, in parts of the picture
        const world = job.thickness === 1 ? {} : { worldDistanceThreshold: job.far, worldDistanceFalloff: 1,
            worldProximityThreshold: job.radius * job.thickness, worldProximityFalloff: job.radius * job.thickness / 2 };
        const radius = job.radiusScale === 1 ? 0.1825 : Math.min(height * job.radiusScale, 1);
        const effect = new SSAOEffect(v.camera, normals.texture, { luminanceInfluence: 0, radius, intensity: job.strength, ...world });
        composer.addPass(new RenderPass(v.scene, v.camera));
        composer.addPass(normals);
        composer.addPass(new EffectPass(v.camera, effect));
        composer.render(0);
        return v.renderer.recording.output(v.renderer.texture(v.renderer.lastTarget.texture));
    },
    // Defaults: radius 2, totalStrength 1, maxZ 100, minZAspect 0.2, epsilon 0.02, 8 samples; the sizes of its
    // documentation's example, half for the estimate and full for the blur.
    "babylon-ssao2": async (job, load) => recordBabylon(job, load),
};
