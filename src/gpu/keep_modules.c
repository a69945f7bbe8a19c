/* For builds with AddressSanitizer only: nothing is unloaded before the end of the process, so
   that what a driver leaks is still known to be the driver's (tools/leaks.supp). */
int dlclose(void* module);
int dlclose(void* module)
{
    (void)module;
    return 0;
}
