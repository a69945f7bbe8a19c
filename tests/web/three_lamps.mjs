// Dims the lamps of a bake by lumel-three in a browser, and prints what it finds as JSON:
//     node three_lamps.mjs FOLDER --modules FOLDER --plain FOLDER --steps FILE
// FOLDER: a bake with --per-lamp; --plain: one without. steps: [{ NAME: { factor, colour } … } …], as of setLamps().
//     node three_lamps.mjs FOLDER --modules FOLDER --example
// works the sliders of examples/threejs/lamps.html instead.
// Exits with 0, or with 1 and a sentence.

import { readFile } from 'node:fs/promises';
import { dirname, extname, join, normalize } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';
import { visit } from '../../examples/threejs/browser.mjs';

const source = join(dirname(fileURLToPath(import.meta.url)), '../..');
const { values: options, positionals: [folder] } = parseArgs({
    allowPositionals: true,
    options: { modules: { type: 'string' }, plain: { type: 'string' }, steps: { type: 'string' },
        example: { type: 'boolean' } },
});

// Runs in a page. lamps: of lamps.json; pages: names of the maps of each.
async function probe(lamps, pages, steps) {
    const THREE = await import('three');
    const { EXRLoader } = await import('three/addons/loaders/EXRLoader.js');
    const { GLTFLoader } = await import('three/addons/loaders/GLTFLoader.js');
    const { KTX2Loader } = await import('three/addons/loaders/KTX2Loader.js');
    const { FullScreenQuad } = await import('three/addons/postprocessing/Pass.js');
    const { LightmapPlugin, lampsOf, loadLitScene } = await import('lumel-three');
    const width = 320, height = 240;
    const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
    renderer.setSize(width, height);

    async function exr(path) {
        const loader = new EXRLoader();
        loader.setDataType(THREE.FloatType);
        const { image: { width: side, data } } = await loader.loadAsync(path);
        const texels = new Float32Array(data.length); // EXRLoader begins with the bottom row
        for (let y = 0, row = 4 * side; y < side; ++y)
            texels.set(data.subarray(row * y, row * (y + 1)), row * (side - 1 - y));
        return { side, texels };
    }
    // RGBA of a square texture, × intensity.
    function texelsOf(texture, intensity, side) {
        const into = new THREE.WebGLRenderTarget(side, side, { type: THREE.FloatType, depthBuffer: false });
        const quad = new FullScreenQuad(new THREE.RawShaderMaterial({ glslVersion: THREE.GLSL3,
            uniforms: { map: { value: texture }, intensity: { value: intensity } },
            vertexShader: 'in vec3 position; void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }',
            fragmentShader: `precision highp float; uniform highp sampler2D map; uniform float intensity; out vec4 made;
                void main() { made = intensity * texelFetch(map, ivec2(gl_FragCoord.xy), 0); }` }));
        renderer.setRenderTarget(into);
        quad.render(renderer);
        const texels = new Float32Array(4 * side * side);
        renderer.readRenderTargetPixels(into, 0, 0, side, side, texels);
        renderer.setRenderTarget(null);
        into.dispose();
        return texels;
    }
    // The lightmaps that materials use now, by page.
    function lightOf({ scene }) {
        const found = [];
        scene.traverse(({ material }) => {
            if (material?.lightMap) found[material.userData.lumel.page ?? 0] = material;
        });
        return found.map(({ lightMap, lightMapIntensity }) => texelsOf(lightMap, lightMapIntensity, truth[0][0].side));
    }
    function pictureOf(gltf) {
        const scene = new THREE.Scene(), [camera] = gltf.cameras, gl = renderer.getContext();
        scene.add(gltf.scene);
        camera.aspect = width / height;
        camera.updateProjectionMatrix();
        scene.updateMatrixWorld(true);
        renderer.render(scene, camera);
        const pixels = new Uint8Array(4 * width * height);
        gl.readPixels(0, 0, width, height, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
        return pixels.filter((_, i) => i % 4 < 3);
    }
    // Mean difference of covered texels, relative to the mean light; and the largest, relative to the brightest.
    function apart(light, wantedAt) {
        let sum = 0, all = 0, largest = 0, brightest = 0;
        light.forEach((texels, page) => texels.forEach((value, i) => {
            if (i % 4 === 3 || truth[0][page].texels[i - i % 4 + 3] === 0) return;
            const wanted = wantedAt(page, i), difference = Math.abs(value - wanted);
            sum += difference, all += wanted;
            largest = Math.max(largest, difference), brightest = Math.max(brightest, wanted);
        }));
        return { mean: all > 0 ? sum / all : sum, largest: brightest > 0 ? largest / brightest : largest };
    }
    // Error of the change of all light since the bake, relative to what the change should be: of the worst channel.
    function changeOf(light, wantedAt) {
        const sums = [0, 1, 2].map(() => [0, 0]);
        light.forEach((texels, page) => texels.forEach((value, i) => {
            if (i % 4 === 3 || truth[0][page].texels[i - i % 4 + 3] === 0) return;
            sums[i % 4][0] += value - plainLight[page][i];
            sums[i % 4][1] += wantedAt(page, i) - plainLight[page][i];
        }));
        return Math.max(...sums.map(([sum, wanted]) => Math.abs(sum - wanted)))
            / Math.max(...sums.map(([, wanted]) => Math.abs(wanted)));
    }
    const differenceOf = (one, other) => one.reduce((sum, value, i) => sum + Math.abs(value - other[i]), 0) / one.length;
    const messageOf = (work) => {
        try {
            return void work();
        } catch (error) {
            return error.message;
        }
    };
    // All of the materials but what lamps change.
    function described({ scene }) {
        const found = [];
        scene.traverse(({ name, material }) => {
            if (!material) return;
            const { uuid, metadata, emissive, lightMap, textures, images, ...rest } = material.toJSON();
            found.push([name, material.constructor.name, rest]);
        });
        return JSON.stringify(found, (key, value) => /map$/i.test(key) && typeof value === 'string' ? 'a map' : value);
    }

    const truth = await Promise.all(pages.map((names) => Promise.all(names.map((name) => exr(`/${name}`)))));
    const loader = new GLTFLoader().setKTX2Loader(new KTX2Loader().detectSupport(renderer));
    loader.register((parser) => new LightmapPlugin(parser));
    const asLoaded = await loader.loadAsync('/scene.glb');
    asLoaded.scene.traverse(({ material }) => { if (material?.isMeshStandardMaterial) material.metalness = 0; });
    const plainLight = lightOf(asLoaded), beforeLamps = described(asLoaded);
    const gltf = await loadLitScene(renderer, '/scene.glb');
    const exposure = renderer.toneMappingExposure;
    const asBaked = pictureOf(gltf);
    const found = { names: gltf.lamps, same: described(gltf) === beforeLamps,
        plain: apart(lightOf(gltf), (page, i) => plainLight[page][i]), picture: differenceOf(asBaked, pictureOf(asLoaded)) };

    const lightMapsOf = ({ scene }) => {
        const maps = [];
        scene.traverse(({ material }) => { if (material?.lightMap) maps.push(material.lightMap); });
        return maps;
    };
    const texturesInUse = () => renderer.info.memory.textures;
    const texturesAtFirst = texturesInUse(), mapsAtFirst = lightMapsOf(gltf);
    found.own = mapsAtFirst.every(({ isExternalTexture }) => !isExternalTexture);

    const luxOf = ([r, g, b]) => 0.2126 * r + 0.7152 * g + 0.0722 * b;
    const states = lamps.map(() => ({ factor: 1, colour: null }));
    const gainOf = ({ factor, colour }, { color }) => {
        if (!colour) return [factor, factor, factor];
        const { r, g, b } = new THREE.Color(colour);
        const scale = factor * luxOf(color) / luxOf([r, g, b]);
        return [r, g, b].map((value, channel) => scale * value / color[channel]);
    };
    found.steps = steps.map((step) => {
        // One by one, as sliders do, or together.
        if (Object.keys(step).length > 2) gltf.setLamps(step);
        else for (const [name, state] of Object.entries(step)) gltf.setLamp(name, state);
        lamps.forEach(({ name }, k) => Object.assign(states[k], step[name]));
        const gains = lamps.map((lamp, k) => gainOf(states[k], lamp));
        const wantedAt = (page, i) => gains.reduce((sum, gain, k) => sum + gain[i % 4] * truth[k][page].texels[i], 0);
        const light = lightOf(gltf), picture = pictureOf(gltf), baked = gains.flat().every((gain) => gain === 1);
        return { ...apart(light, wantedAt), changed: baked ? 0 : changeOf(light, wantedAt),
            brightest: picture.reduce((a, b) => Math.max(a, b)), change: differenceOf(picture, asBaked) };
    });
    // Twice the light at half the exposure.
    gltf.setLamps(Object.fromEntries(gltf.lamps.map((name) => [name, { factor: 2, colour: null }])));
    renderer.toneMappingExposure = exposure / 2;
    found.twice = differenceOf(pictureOf(gltf), asBaked);
    gltf.setLamps(new Map(gltf.lamps.map((name) => [name, { factor: 1 }])));
    renderer.toneMappingExposure = exposure;
    found.again = differenceOf(pictureOf(gltf), asBaked);

    const [first] = gltf.lamps;
    const again = await lampsOf(renderer, gltf);
    found.messages = [() => gltf.setLamp('toaster', { factor: 0 }), () => gltf.setLamp('constructor', {}),
        () => gltf.setLamps({ [first]: { factor: 0 }, toaster: {} }), () => gltf.setLamp(first, { factor: -1 }),
        () => gltf.setLamp(first, { factor: '1' }), () => gltf.setLamp(first, { colour: 'warm' })].map(messageOf);
    found.unharmed = differenceOf(pictureOf(gltf), asBaked);
    // Twice: what is freed is made again.
    found.freed = [0, 1].map(() => {
        gltf.setLamp(first, { factor: 0 });
        const bound = lightMapsOf(gltf), dimmed = differenceOf(pictureOf(gltf), asBaked), during = texturesInUse();
        gltf.dispose();
        const maps = lightMapsOf(gltf), picture = differenceOf(pictureOf(gltf), asBaked);
        return { before: texturesAtFirst, during, after: texturesInUse(), dimmed, picture,
            replaced: bound.every((map, i) => map !== mapsAtFirst[i]),
            restored: maps.length === mapsAtFirst.length && maps.every((map, i) => map === mapsAtFirst[i]) };
    });
    found.inUse = messageOf(() => again.setLamp(first, {}));
    const without = await loadLitScene(renderer, '/plain.glb');
    found.without = { names: without.lamps, message: messageOf(() => without.setLamp('sun', { factor: 0 })) };
    asLoaded.asset.extras.lumel.lamps.bufferView = 0; // as if a tool had renumbered the views
    const stripped = await lampsOf(renderer, asLoaded);
    found.stripped = { names: stripped.lamps, message: messageOf(() => stripped.setLamp(first, {})) };
    return found;
}

// Runs in the page of the example.
async function work() {
    const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
    while (!document.documentElement.dataset.state) await pause(50);
    const canvas = document.querySelector('canvas'), copy = document.createElement('canvas');
    const mean = () => {
        [copy.width, copy.height] = [canvas.width, canvas.height];
        const context = copy.getContext('2d', { willReadFrequently: true });
        context.drawImage(canvas, 0, 0);
        const { data } = context.getImageData(0, 0, copy.width, copy.height);
        return [0, 1, 2].map((channel) =>
            data.reduce((sum, value, i) => i % 4 === channel ? sum + value : sum, 0) / (data.length / 4));
    };
    const labels = [...document.querySelectorAll('label')], baked = mean();
    const enter = (kind, value) => labels.forEach((label) => {
        const input = label.querySelector(`[type=${kind}]`);
        input.value = value;
        input.dispatchEvent(new Event('input'));
    });
    enter('color', '#ff8000');
    const orange = mean();
    enter('range', 0);
    return { names: labels.map((label) => label.textContent.trim()), baked, orange, off: mean() };
}

const types = { '.js': 'text/javascript', '.html': 'text/html; charset=utf-8' };

// The file that a path of the page stands for.
function fileOf(path) {
    if (path === '/plain.glb') return join(options.plain, 'scene.glb');
    if (path === '/lamps.js') return join(source, 'examples/threejs/lamps.js');
    if (path.startsWith('/node_modules/lumel-three/')) return join(source, 'addons/three', normalize(path.slice(25)));
    if (path.startsWith('/node_modules/')) return join(options.modules, normalize(path.slice(13)));
    return join(folder, normalize(path));
}

// Sends back what a function finds.
const script = (asked, ...values) => `<script type="module">
    const fail = (error) => fetch('/failure', { method: 'POST', body: String(error?.stack ?? error) });
    addEventListener('error', ({ message }) => fail(message));
    const errors = [];
    for (const kind of ['error', 'warn']) console[kind] = (...words) => errors.push(kind + ': ' + words.join(' '));
    try {
        const found = await (${asked})(...${JSON.stringify(values).replaceAll('<', '\\u003c')});
        await fetch('/found', { method: 'POST', body: JSON.stringify({ ...found, errors }) });
    } catch (error) {
        fail(error);
    }
</script>`;

try {
    const example = await readFile(join(source, 'examples/threejs/lamps.html'), 'utf8');
    let page = example + script(work);
    if (!options.example) {
        const { lamps } = JSON.parse(await readFile(join(folder, 'lamps.json'), 'utf8'));
        const { sizes } = JSON.parse(await readFile(join(folder, 'report.json'), 'utf8'));
        const pages = lamps.map(({ map }) => Array.from({ length: sizes.pages ?? 1 }, (_, page) =>
            map.replace(/-0\.exr$/, `-${page}.exr`)));
        const steps = JSON.parse(await readFile(options.steps, 'utf8'));
        page = example.match(/<script type="importmap">.*?<\/script>/s)[0] + script(probe, lamps, pages, steps);
    }
    const { body } = await visit('chromium', '', async (path) => path === '/'
        ? { type: types['.html'], content: page }
        : { type: types[extname(path)] ?? 'application/octet-stream', content: await readFile(fileOf(path)) }, '/found');
    console.log(body.toString());
} catch (error) {
    console.error(`three_lamps.mjs: ${error.message}`);
    process.exitCode = 1;
}
