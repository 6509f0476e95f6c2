// The program on its own, as CMake builds it; the program delotet contains the same.
extern "C" int delotet_tetgen_main(int count, const char *const *words);

int main(int argc, char **argv)
{
    return delotet_tetgen_main(argc > 0 ? argc - 1 : 0, argv + 1);
}
