# What is compiled into the programs and needs its notice beside them, besides the shared libraries: packages of
# headers, and modules of npm in the pages for browsers.
set(LUMEL_HEADER_PACKAGES libcli11-dev nlohmann-json3-dev libglm-dev libvulkan-volk-dev libvulkan-dev libimgui-dev)
set(LUMEL_PAGE_MODULES three ktx-parse)
