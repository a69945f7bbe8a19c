// Lightmaps of Lumel in three.js.

import * as THREE from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';

/** A plugin of GLTFLoader that binds what MOZ_lightmap names. */
export class LightmapPlugin {
    constructor(parser) {
        this.parser = parser;
        this.name = 'MOZ_lightmap';
    }

    async extendMaterialParams(index, params) {
        const lightmap = this.parser.json.materials[index].extensions?.[this.name];
        if (!lightmap) return;
        params.lightMapIntensity = lightmap.intensity;
        await this.parser.assignTexture(params, 'lightMap', lightmap, THREE.LinearSRGBColorSpace);
    }
}

/** Lumel counts metals as diffuse; three.js shows them black where there is no environment map. */
export function makeDiffuse(gltf) {
    gltf.scene.traverse((object) => {
        if (object.material?.isMeshStandardMaterial) object.material.metalness = 0;
    });
}

/** Loads a scene.glb and sets the renderer's exposure for it. */
export async function loadLitScene(renderer, url) {
    const loader = new GLTFLoader();
    loader.setKTX2Loader(new KTX2Loader().detectSupport(renderer));
    loader.register((parser) => new LightmapPlugin(parser));
    const gltf = await loader.loadAsync(url);
    makeDiffuse(gltf); // to be left out where the scene has an environment map
    // White paint that receives H lx sends H / π, and shows as exposure × H.
    renderer.toneMapping = THREE.LinearToneMapping;
    renderer.toneMappingExposure = Math.PI * gltf.asset.extras.lumel.exposure;
    return gltf;
}

/** Lumel's own tone curve in place of a linear one, for WebGLRenderer: bright light fades to white. */
export function useToneCurve(renderer) {
    const { ShaderChunk } = THREE;
    ShaderChunk.tonemapping_pars_fragment = ShaderChunk.tonemapping_pars_fragment.replace(
        'vec3 CustomToneMapping( vec3 color ) { return color; }',
        `vec3 CustomToneMapping( vec3 color ) {
            vec3 x = toneMappingExposure * color;
            return mix( x, 1.0 - 0.4 * exp( ( 0.6 - x ) / 0.4 ), step( 0.6, x ) );
        }`);
    renderer.toneMapping = THREE.CustomToneMapping;
}

/** Binds lightmap.exr to a scene.glb whose MOZ_lightmap a tool has dropped, but not its extras. */
export async function bindLightmap(gltf, url) {
    const map = await new EXRLoader().loadAsync(url);
    map.flipY = true; // EXRLoader begins with the bottom row, glTF counts from the top
    map.channel = 1; // TEXCOORD_1
    gltf.scene.traverse((object) => {
        if (!object.material?.userData.lumel?.lightmap) return;
        object.material.lightMap = map; // [lx]
        object.material.lightMapIntensity = 1;
        object.material.needsUpdate = true;
    });
}
