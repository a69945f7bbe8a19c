export * from './lamps.js';
export * from './lightmap.js';
