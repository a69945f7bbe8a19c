// Lightmaps of Lumel in three.js.

import * as THREE from 'three';
import { MeshoptDecoder } from 'three/addons/libs/meshopt_decoder.module.js';
import { DRACOLoader } from 'three/addons/loaders/DRACOLoader.js';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';
import { GLTFLoader } from 'three/addons/loaders/GLTFLoader.js';
import { KTX2Loader } from 'three/addons/loaders/KTX2Loader.js';
import { lampsOf } from './lamps.js';

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

/**
 * Loads a scene.glb and sets the renderer's exposure for it. The result also has the lamps, see lampsOf().
 * dracoPath: of three's examples/jsm/libs/draco/gltf/, for --compress draco.
 */
export async function loadLitScene(renderer, url, dracoPath) {
    const loader = new GLTFLoader();
    loader.setKTX2Loader(new KTX2Loader().detectSupport(renderer));
    loader.setMeshoptDecoder(MeshoptDecoder); // for --compress meshopt
    if (dracoPath) loader.setDRACOLoader(new DRACOLoader().setDecoderPath(dracoPath));
    loader.register((parser) => new LightmapPlugin(parser));
    const gltf = await loader.loadAsync(url);
    makeDiffuse(gltf); // to be left out where the scene has an environment map
    // White paint that receives H lx sends H / π, and shows as AgX of exposure × H.
    renderer.toneMapping = THREE.AgXToneMapping;
    renderer.toneMappingExposure = Math.PI * gltf.asset.extras.lumel.exposure;
    return Object.assign(gltf, await lampsOf(renderer, gltf));
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
