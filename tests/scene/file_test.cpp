// Files and URIs: what is read, and what must never be.

#include <gtest/gtest.h>

#include "gltf_builder.h"

using namespace lumel;
using namespace lumel::test;

namespace fs = std::filesystem;

namespace {

/// The triangle as a .gltf whose buffer is at `uri`.
std::string write_gltf(const TempFolder& folder, const std::string& uri,
                       const std::string& name = "scene.gltf")
{
    GltfBuilder builder = one_triangle();
    builder.json["buffers"] = Json::array({{{"byteLength", builder.buffer.size()}, {"uri", uri}}});
    return folder.write(name, builder.json.dump());
}

Bytes triangle_bytes()
{
    return one_triangle().buffer;
}

/// Error of a scene in scenes/ of the folder whose buffer is at `uri`.
std::string error_with_uri(const TempFolder& folder, const std::string& uri)
{
    return error_of_file(write_gltf(folder, uri, "scenes/scene.gltf"));
}

}  // namespace

TEST(Files, WhatIsNoFileIsAnError)
{
    const TempFolder folder;
    EXPECT_TRUE(contains(error_of_file(folder.path("nothing.glb")), "no such file"));
    EXPECT_TRUE(contains(error_of_file(folder.path("")), "is a folder"));
    EXPECT_TRUE(contains(error_of_file(folder.write("empty.glb", Bytes{})), "is empty"));
    EXPECT_TRUE(contains(error_of_file("/dev/zero"), "not a regular file"));
    fs::resize_file(folder.write("huge.glb", Bytes(1)), std::uintmax_t(1) << 40);
    EXPECT_TRUE(contains(error_of_file(folder.path("huge.glb")), "larger than 8 GiB"));
    EXPECT_NE(error_of_file(""), "");
}

TEST(Files, UrisMayBePercentEncodedOrNot)
{
    const TempFolder folder;
    folder.write("my buffer ä%.bin", triangle_bytes());
    EXPECT_EQ(error_of_file(write_gltf(folder, "my%20buffer%20%C3%A4%25.bin")), "");
    EXPECT_EQ(error_of_file(write_gltf(folder, "my buffer ä%25.bin")), "");
    EXPECT_TRUE(contains(error_of_file(write_gltf(folder, "my%2")), "not a valid URI"));
    EXPECT_NE(error_of_file(write_gltf(folder, "a%00b")), "");
}

TEST(Files, SubfoldersAreInside)
{
    const TempFolder folder;
    folder.write("scenes/data/buffer.bin", triangle_bytes());
    EXPECT_EQ(error_with_uri(folder, "data/buffer.bin"), "");
    EXPECT_EQ(error_with_uri(folder, "./data/../data/buffer.bin"), "");
    EXPECT_TRUE(contains(error_with_uri(folder, "data"), "is a folder"));
    EXPECT_TRUE(contains(error_with_uri(folder, "data/nothing.bin"), "no such file"));
}

TEST(Files, UrisThatLeaveTheFolderAreErrors)
{
    const TempFolder folder;
    const std::string outside = folder.write("buffer.bin", triangle_bytes());
    folder.write("scenes_other/buffer.bin", triangle_bytes());
    for (const std::string uri :
         {"../buffer.bin", "%2e%2e/buffer.bin", "..%2Fbuffer.bin", "../scenes_other/buffer.bin"})
        EXPECT_TRUE(contains(error_with_uri(folder, uri), "/buffers/0/uri: names")) << uri;
    EXPECT_TRUE(contains(error_with_uri(folder, outside), "absolute path"));
    EXPECT_TRUE(contains(error_with_uri(folder, "file://" + outside), "scheme \"file\""));
    EXPECT_TRUE(contains(error_with_uri(folder, "http://example.org/a"), "scheme \"http\""));
    EXPECT_TRUE(contains(error_with_uri(folder, "C:\\a.bin"), "scheme"));
    EXPECT_NE(error_with_uri(folder, "//host/buffer.bin"), "");
    EXPECT_NE(error_with_uri(folder, ""), "");
}

TEST(Files, LinksThatLeaveTheFolderAreErrors)
{
    const TempFolder folder;
    const std::string outside = folder.write("buffer.bin", triangle_bytes());
    folder.write("scenes/inside.bin", triangle_bytes());
    fs::create_symlink(outside, folder.path("scenes/out.bin"));
    fs::create_symlink("inside.bin", folder.path("scenes/in.bin"));
    fs::create_symlink("loop.bin", folder.path("scenes/loop.bin"));
    EXPECT_TRUE(contains(error_with_uri(folder, "out.bin"), "outside the scene's folder"));
    EXPECT_EQ(error_with_uri(folder, "in.bin"), "");
    EXPECT_NE(error_with_uri(folder, "loop.bin"), "");
}

TEST(Files, ScenesAreFoundByRelativePaths)
{
    const TempFolder folder;
    folder.write("buffer.bin", triangle_bytes());
    const std::string path = write_gltf(folder, "buffer.bin");
    const fs::path before = fs::current_path();
    fs::current_path(fs::path(path).parent_path());
    const std::string error = error_of_file("scene.gltf");
    fs::current_path(before);
    EXPECT_EQ(error, "");
}

TEST(Files, DataUrisAreDecoded)
{
    const TempFolder folder;
    // 36 bytes: (0,0,0) (1,0,0) (0,1,0) as floats.
    const std::string base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    const std::string head = "data:application/octet-stream;base64,";
    EXPECT_EQ(error_of_file(write_gltf(folder, head + base64)), "");
    EXPECT_TRUE(contains(error_of_file(write_gltf(folder, head + "AAAA")), "should hold 36 bytes"));
    EXPECT_TRUE(contains(error_of_file(write_gltf(folder, head + "A*AA")), "not base64"));
    EXPECT_TRUE(contains(error_of_file(write_gltf(folder, head + "A")), "cut short"));
    EXPECT_TRUE(contains(error_of_file(write_gltf(folder, "data:nothing")), "no comma"));
    std::string percent = "data:,";
    for (std::uint8_t byte : triangle_bytes()) {
        char text[4];
        std::snprintf(text, sizeof text, "%%%02X", byte);
        percent += text;
    }
    EXPECT_EQ(error_of_file(write_gltf(folder, percent)), "");
}

TEST(Files, MessagesQuoteNoControlCharacters)
{
    const TempFolder folder;
    std::string long_name = "a\nb";
    long_name.append(5000, 'x');
    const std::string error = error_of_file(write_gltf(folder, long_name));
    EXPECT_EQ(error.find('\n'), std::string::npos);
    EXPECT_LT(error.size(), 1000u);
}
