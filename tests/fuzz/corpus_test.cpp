// What the fuzzers begin with, and what they have found, is read or refused with one line.

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "../../fuzz/readers.h"
#include "../support/source_folder.h"
#include "base/core/error.h"
#include "base/core/files.h"

namespace lumel {
namespace {

namespace fs = std::filesystem;

/// Name and contents of each file of a reader's corpus, sorted.
std::vector<std::pair<std::string, Bytes>> corpus_of(const char* reader)
{
    std::vector<std::pair<std::string, Bytes>> files;
    for (const auto& entry : fs::directory_iterator(support::source_path("fuzz/corpus/") + reader))
        files.emplace_back(entry.path().filename(),
                           read_file(entry.path().string(), entry.path().string()));
    std::sort(files.begin(), files.end());
    return files;
}

bool is_read(void (*read)(fuzz::Input), const Bytes& bytes)
{
    try {
        read(bytes);
        return true;
    } catch (const Error& error) {
        const std::string text = error.what();
        EXPECT_EQ(error.kind(), ErrorKind::input) << text;
        EXPECT_EQ(text.find('\n'), text.npos) << text;
        return false;
    }
}

TEST(FuzzCorpus, FilesAreReadAndBadOnesRefused)
{
    for (const fuzz::Reader& reader : fuzz::kReaders) {
        const auto files = corpus_of(reader.name);
        EXPECT_FALSE(files.empty()) << reader.name;
        for (const auto& [name, bytes] : files)
            EXPECT_EQ(is_read(reader.read, bytes), !name.starts_with("bad-"))
                << reader.name << ": " << name;
    }
}

TEST(FuzzCorpus, FilesThatAreCutShortAreReadOrRefused)
{
    constexpr std::size_t kCuts = 50;
    for (const fuzz::Reader& reader : fuzz::kReaders)
        for (const auto& [name, bytes] : corpus_of(reader.name))
            for (std::size_t cut = 1; cut < kCuts; ++cut)
                is_read(reader.read,
                        Bytes(bytes.begin(),
                              bytes.begin() + std::ptrdiff_t(bytes.size() * cut / kCuts)));
}

}  // namespace
}  // namespace lumel
