// Surfaces that shine with their lamp.

// Names by which a lamp may list a surface: its node, or its material.
const namesOf = (object) =>
    [object, object.parent].map(({ name, userData }) => userData.name ?? name).concat(object.material.name);

/** For each lamp, the materials of its emissive surfaces, as { material, emissive }. */
export function lampSurfaces(scene, lamps) {
    const listed = new Set(lamps.flatMap(({ members }) => members));
    const shining = [];
    scene.traverse((object) => {
        const { r = 0, g = 0, b = 0 } = object.material?.emissive ?? {};
        if (r + g + b > 0 && namesOf(object).some((name) => listed.has(name))) shining.push(object);
    });
    // Surfaces of several lamps can share a material.
    for (const object of shining) object.material = object.material.clone();
    return lamps.map(({ members }) =>
        shining.filter((object) => namesOf(object).some((name) => members.includes(name)))
            .map(({ material }) => ({ material, emissive: material.emissive.clone() })));
}

/** Multiplies the light of such surfaces. gain: linear RGB. */
export function dim(surfaces, gain) {
    for (const { material, emissive } of surfaces)
        material.emissive.setRGB(emissive.r * gain[0], emissive.g * gain[1], emissive.b * gain[2]);
}
