/* Loads plugins with RTLD_GLOBAL, as careless hosts do, and calls each. */
#include <dlfcn.h>
#include <stdio.h>

int main(int count, char **names)
{
    int i;

    for (i = 1; i < count; i++) {
        void *plugin = dlopen(names[i], RTLD_NOW | RTLD_GLOBAL);
        unsigned (*cube)(void) = NULL;
        if (plugin)
            *(void **)&cube = dlsym(plugin, "wrap_cube");
        if (!cube || cube() != 6) {
            fprintf(stderr, "%s: %s\n", names[i], cube ? "wrong mesh" : dlerror());
            return 1;
        }
        if (dlsym(plugin, "delotet_version")) {
            fprintf(stderr, "%s exports delotet_version\n", names[i]);
            return 1;
        }
    }
    return count > 2 ? 0 : 1;
}
