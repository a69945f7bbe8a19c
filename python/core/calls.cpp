#include <Python.h>  // before the standard headers, which it configures

#include "calls.h"

#include <mutex>
#include <regex>

#include "module.h"

namespace lumel_python {
namespace {

/// Warnings of the current call on this thread.
std::vector<std::string>& messages()
{
    thread_local std::vector<std::string> of_this_thread;
    return of_this_thread;
}

std::mutex& one_at_a_time()
{
    static std::mutex mutex;
    return mutex;
}

thread_local bool is_calling = false;

/// Marks this thread as one that calls the library.
class Calling {
public:
    Calling() { is_calling = true; }
    ~Calling() { is_calling = false; }
    Calling(const Calling&) = delete;
    Calling& operator=(const Calling&) = delete;
};

const char* name_of(lumel::ErrorKind kind)
{
    switch (kind) {
    case lumel::ErrorKind::input:
        return "input";
    case lumel::ErrorKind::device:
        return "device";
    case lumel::ErrorKind::output:
        return "output";
    case lumel::ErrorKind::stopped:
        return "stopped";
    }
    return "";
}

/// If the user's filters turn warnings into errors, throws the first. After a failed call prints
/// them instead, so that they do not replace its error.
void issue_warnings(bool has_failed)
{
    std::vector<std::string> all;
    all.swap(messages());
    const py::object category = py::module_::import("lumel._core").attr("LumelWarning");
    for (const std::string& message : in_python(std::move(all))) {
        if (PyErr_WarnEx(category.ptr(), message.c_str(), 1) == 0)
            continue;
        if (!has_failed)
            throw py::error_already_set();
        PyErr_WriteUnraisable(nullptr);
    }
}

}  // namespace

void call(const std::function<void()>& work)
{
    if (is_calling)
        throw std::runtime_error("a progress function must not call lumel");
    try {
        const py::gil_scoped_release released;
        const std::scoped_lock alone(one_at_a_time());
        const Calling now;
        work();
    } catch (...) {
        issue_warnings(true);
        throw;
    }
    issue_warnings(false);
}

void free_alone(const std::function<void()>& work)
{
    if (is_calling) {  // and waits for this
        work();
        return;
    }
    const py::gil_scoped_release released;
    const std::scoped_lock alone(one_at_a_time());
    work();
}

void check_signals()
{
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0)
        throw py::error_already_set();
}

std::string in_python(std::string message)
{
    static const std::pair<std::regex, const char*> kWords[] = {
        {std::regex(R"(\b(\w+Settings|Daylight)::)"), ""},
        {std::regex(R"(\b(Materials|Parts)::(\w+))"), "\"$2\""},
        {std::regex(R"(\b(Baked|Scene)::)"), "$1."}};
    for (const auto& [word, replacement] : kWords)
        message = std::regex_replace(message, word, replacement);
    return message;
}

std::vector<std::string> in_python(std::vector<std::string> messages)
{
    for (std::string& message : messages)
        message = in_python(std::move(message));
    return messages;
}

lumel::ProgressFunction ProgressCalls::function()
{
    return [this](const lumel::Progress& now) { return !raised_ && go_on(now); };
}

bool ProgressCalls::go_on(const lumel::Progress& now)
{
    const py::gil_scoped_acquire acquired;
    try {
        check_signals();
        if (tell_.is_none())
            return true;
        const py::object answer = tell_(now);
        // Without conversion only True, False and those of numpy load.
        py::detail::make_caster<bool> loaded;
        return !loaded.load(answer, false) || py::detail::cast_op<bool>(loaded);
    } catch (...) {
        raised_ = std::current_exception();
        return false;
    }
}

void add_calls(py::module_& module)
{
    static PyObject* error = PyErr_NewExceptionWithDoc(
        "lumel.Error",
        "The message is one sentence: location, fault and remedy.\n\nkind: \"input\", \"device\", "
        "\"output\", or \"stopped\" if progress ended a bake before it had a solution.",
        PyExc_RuntimeError, nullptr);
    module.add_object("Error", py::handle(error));
    module.add_object("LumelWarning", py::handle(PyErr_NewExceptionWithDoc(
                                          "lumel.LumelWarning", "A message for the user.",
                                          PyExc_UserWarning, nullptr)));
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown)
                std::rethrow_exception(thrown);
        } catch (const lumel::Error& one) {
            py::object raised = py::handle(error)(in_python(one.what()));
            raised.attr("kind") = name_of(one.kind());
            PyErr_SetObject(error, raised.ptr());
        }
    });
    lumel::on_warning([](const std::string& message) { messages().push_back(message); });

    py::class_<lumel::Progress>(module, "Progress", "Status of a bake.")
        .def_readonly("stage", &lumel::Progress::stage)
        .def_readonly("fraction", &lumel::Progress::fraction, "Of the stage, 0 to 1.")
        .def_readonly("shots", &lumel::Progress::shots)
        .def_readonly("error", &lumel::Progress::error, "Estimated, relative; below 0: unknown.")
        .def_readonly("seconds", &lumel::Progress::seconds, "Since the stage began.");
}

}  // namespace lumel_python
