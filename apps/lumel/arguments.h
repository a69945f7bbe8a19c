#pragma once
// The command line, parsed.

#include <limits>
#include <string>
#include <variant>

#include "jobs/bake/reference.h"
#include "jobs/inspect/measure.h"
#include "jobs/inspect/probes.h"
#include "jobs/inspect/room_report.h"
#include "jobs/inspect/why.h"
#include "jobs/play/play.h"
#include "jobs/relight/relight.h"
#include "jobs/render/render.h"
#include "jobs/solve/bake_options.h"
#include "jobs/update/update.h"
#include "viewer/session/view.h"

namespace lumel {

/// How a command shows its progress on stderr.
enum class ProgressStyle {
    automatic,  ///< a progress bar if it is a terminal
    json,       ///< lines of JSON, for other programs
    none,
};

/// Output of a command while it runs.
struct Talk {
    bool quiet = false;  ///< nothing but warnings and errors
    bool json = false;   ///< stdout carries one JSON document and nothing else
    ProgressStyle progress = ProgressStyle::automatic;
    bool verbose = false;  ///< on stderr what becomes known as it does, a line each
};

struct BakeArguments {
    std::string scene;   ///< glTF or GLB file
    std::string folder;  ///< where the results go
    BakeOptions options;
    bool page = false;  ///< write report.html too
    Talk talk;
};

struct ReferenceArguments {
    std::string scene;
    std::string folder;
    BakeOptions options;
    ReferenceOptions reference;
    MaterialModel materials = MaterialModel::diffuse;  ///< material model to load
    Talk talk;
};

struct RenderArguments {
    std::string scene;
    std::string picture;  ///< PNG or EXR to write
    RenderOptions options;
    Talk talk;
};

struct PlayArguments {
    std::string scene;
    std::string folder;  ///< where pictures and report go
    PlayOptions options;
    Talk talk;
};

struct ViewArguments {
    ScriptRun run;
    SessionOptions options;
    bool headless = false;
    Talk talk;
};

struct UpdateArguments {
    std::string folder;  ///< finished bake
    std::string scene;   ///< as it is now
    UpdateOptions options;
    Talk talk;
};

struct RelightArguments {
    std::string folder;  ///< finished bake
    std::string states;  ///< JSON file
    RelightOptions options;
    Talk talk;
};

struct WhyArguments {
    std::string folder;  ///< finished bake
    WhyOptions options;
    Talk talk;
};

struct MeasureArguments {
    std::string folder;  ///< finished bake
    MeasureOptions options;
    Talk talk;
};

struct ProbesArguments {
    std::string folder;  ///< finished bake
    ProbesOptions options;
    Talk talk;
};

struct InfoArguments {
    std::string scene;
    BakeOptions options;
    bool json = false;
};

struct CompareArguments {
    std::string map;        ///< EXR to judge
    std::string reference;  ///< EXR taken as the truth
    std::string heat_map;   ///< PNG to write; empty: named after the two
    double most = std::numeric_limits<double>::infinity();  ///< brighter texels of it are left out
    bool json = false;
};

struct ReportArguments {
    std::string folder;  ///< finished bake
    std::string other;   ///< finished bake to compare with, or empty
    std::string page;    ///< HTML file to write; empty: report.html in the folder
    RoomOptions room;    ///< without a use: no report of the room
};

struct DevicesArguments {
    bool json = false;
};

struct MethodsArguments {};

/// --help and --version: a text for stdout.
struct TextArguments {
    std::string text;
};

/// The values given to one of the commands.
struct Arguments {
    std::variant<BakeArguments, UpdateArguments, RelightArguments, WhyArguments, MeasureArguments,
                 ProbesArguments, RenderArguments, PlayArguments, ViewArguments, ReferenceArguments,
                 InfoArguments, CompareArguments, ReportArguments, DevicesArguments,
                 MethodsArguments, TextArguments>
        of_command;
};

/// Reads the command line. Throws Error{input} with one sentence for anything it cannot use.
Arguments parse_arguments(int count, char** values);

}  // namespace lumel
