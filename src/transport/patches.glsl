// Patches of a chart by level. The includer declares `PatchChart charts[]`.

uint points_per_lumel(uint level)
{
    return level <= kLumelLevel ? 1u : 1u << (2u * (level - kLumelLevel));
}

uint patches_of(PatchChart chart, uint level)
{
    if (level < kBlockLevels)
        return chart.patch_count[level];
    return chart.lumel_count * points_per_lumel(level);
}
