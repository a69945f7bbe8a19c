import type { Color, WebGLRenderer } from 'three';
import type { GLTF, GLTFLoaderPlugin, GLTFParser } from 'three/addons/loaders/GLTFLoader.js';

/** How a lamp shines, relative to the bake. What is left out stays as it is. */
export interface LampState {
    /** Multiplies its light: 0 is off, 1 as baked. */
    factor?: number;
    /** Another colour, with the same illuminance: "#rrggbb" in sRGB, 0xrrggbb or a Color; null: as baked. */
    colour?: string | number | Color | null;
}

/** Lamps of a scene that was baked with --per-lamp; none of others. */
export interface Lamps {
    /** Their names. */
    lamps: string[];
    /** Changes one lamp. Throws an Error that lists the names if there is none of that name. */
    setLamp(name: string, state: LampState): void;
    /** Changes several lamps at once, which costs as much as one. */
    setLamps(states: Record<string, LampState> | Map<string, LampState>): void;
    /** Shows the scene as baked, and frees the textures that the first change has made. A later change makes them again. */
    dispose(): void;
}

/** A plugin of GLTFLoader that binds what MOZ_lightmap names. */
export class LightmapPlugin implements GLTFLoaderPlugin {
    constructor(parser: GLTFParser);
    readonly name: string;
    extendMaterialParams(index: number, params: Record<string, unknown>): Promise<void>;
}

/**
 * Loads a scene.glb, sets the renderer's tone mapping and exposure for it, and finds its lamps.
 * dracoPath: of three's examples/jsm/libs/draco/gltf/, for --compress draco.
 */
export function loadLitScene(renderer: WebGLRenderer, url: string, dracoPath?: string): Promise<GLTF & Lamps>;

/** The lamps of a scene that was loaded with LightmapPlugin. */
export function lampsOf(renderer: WebGLRenderer, gltf: GLTF): Promise<Lamps>;

/** Makes metals diffuse, as Lumel counts them. */
export function makeDiffuse(gltf: GLTF): void;

/** Binds lightmap.exr to a scene.glb whose MOZ_lightmap a tool has dropped, but not its extras. */
export function bindLightmap(gltf: GLTF, url: string): Promise<void>;
