#include "interrupt.h"

#include <csignal>
#include <cstdlib>
#include <ctime>

namespace lumel {
namespace {

// The only state a signal handler may touch.
volatile std::sig_atomic_t caught_signal = 0;
volatile std::sig_atomic_t caught_at = 0;  // milliseconds()

/// Within this time a second signal is the same request [ms]: `timeout` signals the program, and at
/// once its process group.
constexpr int kSameRequest = 500;

/// Of the monotonic clock, modulo kClockSeconds.
int milliseconds()
{
    constexpr int kClockSeconds = 1'000'000, kPerSecond = 1000, kNanosecondsPer = 1'000'000;
    timespec time = {};
    clock_gettime(CLOCK_MONOTONIC, &time);
    return static_cast<int>(time.tv_sec % kClockSeconds) * kPerSecond +
           static_cast<int>(time.tv_nsec / kNanosecondsPer);
}

extern "C" void note_signal(int signal)
{
    if (caught_signal == 0) {
        caught_at = milliseconds();
        caught_signal = signal;
    } else if (std::abs(milliseconds() - caught_at) > kSameRequest) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
    }
}

void watch(int signal)
{
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    // A parent that had us ignore the signal (nohup, a shell's background job) has its reason.
    if (before.sa_handler == SIG_IGN)
        return;
    struct sigaction action = {};
    action.sa_handler = note_signal;
    sigemptyset(&action.sa_mask);
    action.sa_flags = static_cast<int>(SA_RESTART);
    sigaction(signal, &action, nullptr);
}

}  // namespace

void watch_interrupts()
{
    watch(SIGINT);
    watch(SIGTERM);
    watch(SIGHUP);
    watch(SIGUSR1);  // which mpirun passes on, and Slurm sends before a job's time is over
}

bool interrupted()
{
    return caught_signal != 0;
}

int interrupt_exit_code()
{
    return 128 + static_cast<int>(caught_signal);
}

}  // namespace lumel
