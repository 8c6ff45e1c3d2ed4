// SPDX-License-Identifier: MIT
// A list of passes, textures and programs that glssao-bench can replay in OpenGL 3.3. Shaders are translated from GLSL
// ES to GLSL 330 here. Nothing of a package is changed otherwise.
import { createHash } from "node:crypto";
import { writeFileSync } from "node:fs";
import { join } from "node:path";

// Random numbers and the clock of the packages, the same in each run.
export function seedRandom() {
    performance.now = () => 0;
    let state = 1;
    Math.random = () => {
        state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
        return state / 4294967296;
    };
}

// GLSL ES 1.00 and 3.00 to 3.30: what differs is the names of inputs, outputs and texture functions.
export function translate(source, isFragment, prefix) {
    const body = source.replace(/^\s*#version.*$/gm, "").replace(/^\s*#extension.*$/gm, "");
    const es3 = /\bout\s+(?:highp|mediump|lowp)?\s*vec4\s+\w+\s*;/.test(body) && isFragment;
    const lines = ["#version 330", "#define texture2D texture", "#define texture2DLodEXT textureLod",
        "#define texture2DLod textureLod", "#define textureCube texture", "#define gl_FragDepthEXT gl_FragDepth",
        isFragment ? "#define varying in" : "#define varying out\n#define attribute in"];
    if (isFragment && !es3)
        lines.push("out vec4 peer_color;", "#define gl_FragColor peer_color");
    return lines.join("\n") + "\n" + prefix + "\n" + body;
}

export class Recording {
    constructor(folder) {
        this.folder = folder;
        this.textures = []; // what each is
        this.numbers = new Map(); // key: the package's own object
        this.programs = [];
        this.passes = [];
        this.clears = new Map(); // colour by texture, for the next pass that draws into it
    }

    store(content, suffix) {
        const name = createHash("sha1").update(content).digest("hex").slice(0, 16) + suffix;
        writeFileSync(join(this.folder, name), content);
        return name;
    }

    // describe() gives width, height, format, linear, repeat, and data (a typed array) or nothing.
    texture(key, describe) {
        if (!this.numbers.has(key)) {
            const { width, height, format, linear, repeat, data } = describe();
            const file = data ? this.store(new Uint8Array(data.buffer, data.byteOffset, data.byteLength), ".raw") : "-";
            this.numbers.set(key, this.textures.length);
            this.textures.push(`texture ${width} ${height} ${format} ${linear ? 1 : 0} ${repeat ? 1 : 0} ${file}`);
        }
        return this.numbers.get(key);
    }

    program(vertex, fragment) {
        const line = `program ${this.store(vertex, ".vert")} ${this.store(fragment, ".frag")}`;
        if (!this.programs.includes(line))
            this.programs.push(line);
        return this.programs.indexOf(line);
    }

    clear(texture, color) {
        this.clears.set(texture, color);
    }

    // targets: numbers of textures; viewport: x, y, width, height; samplers: [name, number of a texture or name of what the
    // host hands over]; uniforms: [name, numbers].
    pass(program, targets, viewport, samplers, uniforms) {
        const clears = targets.filter((target) => this.clears.has(target)).map((target) => [target, this.clears.get(target)]);
        targets.forEach((target) => this.clears.delete(target));
        this.passes.push({ program, targets, viewport, samplers, uniforms, clears });
    }

    // The result is in this texture. Later passes, and those that it does not depend on, are left out.
    output(texture) {
        const needed = new Set([texture]), kept = [];
        for (const pass of this.passes.toReversed()) {
            if (!pass.targets.some((target) => needed.has(target)))
                continue;
            kept.unshift(pass);
            pass.samplers.forEach(([, source]) => needed.add(source));
        }
        this.passes = kept;
        this.result = texture;
        return this;
    }

    write(path) {
        const lines = [...this.textures, ...this.programs];
        for (const pass of this.passes) {
            pass.clears.forEach(([texture, color]) => lines.push(`clear ${texture} ${color.join(" ")}`));
            lines.push(`pass ${pass.program} ${pass.viewport.join(" ")} ${pass.targets.join(" ")}`);
            pass.samplers.forEach(([name, source]) => lines.push(`sampler ${name} ${source}`));
            pass.uniforms.forEach(([name, values]) => lines.push(`uniform ${name} ${values.map(Number).join(" ")}`));
        }
        lines.push(`output ${this.result}`);
        writeFileSync(path, lines.join("\n") + "\n");
    }
}
