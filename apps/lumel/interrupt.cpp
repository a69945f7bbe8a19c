#include "interrupt.h"

#include <csignal>

namespace lumel {
namespace {

// The only state a signal handler may touch.
volatile std::sig_atomic_t caught_signal = 0;

extern "C" void note_signal(int signal)
{
    caught_signal = signal;
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
    // Back to the default after the first, so that the second ends the program.
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
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
