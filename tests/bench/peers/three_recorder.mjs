// SPDX-License-Identifier: MIT
// Stands in for three's WebGLRenderer: passes call it as they always do, and it notes what they would have drawn. Scenes
// are not drawn. Their depth and normals are what glssao-bench hands over.
import { Recording, translate } from "./recording.mjs";

export class ThreeRecorder {
    constructor(THREE, scene, folder, width, height) {
        this.THREE = THREE;
        this.scene = scene;
        this.recording = new Recording(folder);
        this.width = width;
        this.height = height;
        this.target = null;
        this.clearColor = new THREE.Color(0, 0, 0);
        this.clearAlpha = 0;
        this.autoClear = true;
        this.autoClearDepth = true;
        this.host = new Map(); // textures that show what the host hands over
        this.capabilities = { isWebGL2: true, logarithmicDepthBuffer: false, reversedDepthBuffer: false,
            getMaxAnisotropy: () => 1, maxSamples: 4 };
        this.extensions = { has: () => true, get: () => ({}) };
        this.xr = { enabled: false, isPresenting: false };
        this.shadowMap = { autoUpdate: false, needsUpdate: false };
        this.info = { autoReset: true };
        this.state = { buffers: { depth: { setMask() {}, setTest() {} }, stencil: { setTest() {} }, color: { setMask() {} } } };
        this.properties = { get: () => ({}) };
        this.outputColorSpace = THREE.LinearSRGBColorSpace;
        this.viewport = null;
    }

    // Depth is copied between framebuffers in one place: to the current target.
    getContext() {
        return { getExtension: () => null, getContextAttributes: () => ({ alpha: true }), bindFramebuffer() {},
            blitFramebuffer: () => this.host.set(this.target.depthTexture, "depth") };
    }
    getClearColor(color) { return color.copy(this.clearColor); }
    setClearColor(color, alpha = 1) { this.clearColor.set(color); this.clearAlpha = alpha; }
    getClearAlpha() { return this.clearAlpha; }
    setClearAlpha(alpha) { this.clearAlpha = alpha; }
    getRenderTarget() { return this.target; }
    setRenderTarget(target) { this.target = target; this.viewport = null; }
    getSize(size) { return size.set(this.width, this.height); }
    getDrawingBufferSize(size) { return size.set(this.width, this.height); }
    getPixelRatio() { return 1; }
    setViewport(x, y, width, height) { this.viewport = x.isVector4 ? [x.x, x.y, x.z, x.w] : [x, y, width, height]; }
    setScissorTest() {}
    initRenderTarget() {}

    targetTextures() {
        return this.target.textures ?? [this.target.texture];
    }

    clear(color = true) {
        if (color && this.target && !this.host.has(this.targetTextures()[0]))
            for (const texture of this.targetTextures())
                this.recording.clear(this.texture(texture), [this.clearColor.r, this.clearColor.g, this.clearColor.b, this.clearAlpha]);
    }
    clearDepth() {}

    render(object, camera) {
        if (object === this.scene)
            this.renderScene(object);
        else
            this.renderQuad(object.isScene ? object.children[0] : object, camera);
    }

    renderScene(scene) {
        const material = scene.overrideMaterial;
        this.host.set(this.targetTextures()[0], material?.isMeshNormalMaterial ? "normals" : "white");
        if (this.target.depthTexture)
            this.host.set(this.target.depthTexture, "depth");
    }

    format(texture) {
        const { THREE } = this;
        const channels = { [THREE.RedFormat]: "r", [THREE.RGFormat]: "rg", [THREE.RGBAFormat]: "rgba" }[texture.format];
        const bits = { [THREE.UnsignedByteType]: "8", [THREE.HalfFloatType]: "16f", [THREE.FloatType]: "32f" }[texture.type];
        if (!channels || !bits)
            throw new Error(`a texture of format ${texture.format} and type ${texture.type} is not known`);
        return channels + bits;
    }

    texture(texture) {
        const { THREE } = this;
        return this.recording.texture(texture, () => ({
            width: texture.image.width, height: texture.image.height, format: this.format(texture),
            linear: texture.magFilter !== THREE.NearestFilter, repeat: texture.wrapS === THREE.RepeatWrapping,
            data: texture.isDataTexture ? texture.image.data : null,
        }));
    }

    program(material) {
        const { THREE } = this;
        const resolve = (source) => {
            for (let i = 0; i < 4; i++)
                source = source.replace(/^[ \t]*#include +<([\w\d./]+)>/gm, (_, name) => THREE.ShaderChunk[name] ?? "");
            return source.replace(/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g,
                (_, start, end, body) => {
                    let unrolled = "";
                    for (let i = Number(start); i < Number(end); i++)
                        unrolled += body.replace(/\[\s*i\s*\]/g, `[ ${i} ]`).replace(/UNROLLED_LOOP_INDEX/g, i);
                    return unrolled;
                });
        };
        const defines = Object.entries(material.defines ?? {}).filter(([, value]) => value !== false)
            .map(([name, value]) => `#define ${name} ${value}`).join("\n");
        const raw = material.isRawShaderMaterial;
        const vertex = raw ? "" : "in vec3 position;\nin vec2 uv;\nuniform mat4 projectionMatrix, modelViewMatrix, viewMatrix;\n";
        const fragment = raw ? "" : "uniform mat4 viewMatrix;\nuniform vec3 cameraPosition;\n" + THREE.ShaderChunk.colorspace_pars_fragment
            + "\nvec4 linearToOutputTexel(vec4 value) { return value; }\n"
            + "float luminance(const in vec3 c) { return dot(c, vec3(0.2126, 0.7152, 0.0722)); }\n";
        return this.recording.program(translate(resolve(material.vertexShader), false, defines + "\n" + vertex),
            translate(resolve(material.fragmentShader), true, defines + "\n" + fragment));
    }

    renderQuad(mesh, camera) {
        const material = mesh.material;
        this.lastTarget = this.target;
        if (!this.target)
            throw new Error(`a pass of ${material.type} draws to the screen`);
        const viewport = this.viewport ?? (this.target.viewport ? [this.target.viewport.x, this.target.viewport.y,
            this.target.viewport.z, this.target.viewport.w] : [0, 0, this.target.width, this.target.height]);
        const identity = new this.THREE.Matrix4().elements, samplers = [];
        const uniforms = [["projectionMatrix", camera.projectionMatrix.elements], ["modelViewMatrix", identity],
            ["viewMatrix", identity]]; // a material's own come later and win, as in three
        for (const [name, uniform] of Object.entries(material.uniforms))
            this.value(name, uniform?.value, samplers, uniforms);
        const targets = this.targetTextures().map((texture) => this.texture(texture));
        this.recording.pass(this.program(material), targets, viewport, samplers, uniforms);
    }

    value(name, value, samplers, uniforms) {
        if (value === null || value === undefined)
            return;
        if (value.isTexture)
            samplers.push([name, this.host.get(value) ?? this.texture(value)]);
        else if (Array.isArray(value) && value.length > 0 && typeof value[0] === "object")
            uniforms.push([name, value.flatMap((element) => element.toArray())]);
        else if (Array.isArray(value) || ArrayBuffer.isView(value))
            uniforms.push([name, Array.from(value)]);
        else if (typeof value === "object" && value.toArray)
            uniforms.push([name, value.toArray()]);
        else if (typeof value === "number" || typeof value === "boolean")
            uniforms.push([name, [value]]);
    }
}
