// SmallVCM's renders of one of its scenes, with a seed for each and the processor seconds that each took.
//
// Its headers are what is compiled here, as they are; this only asks for a size, a seed and sums in single precision
// where its program asks for neither and writes 8 bits.
//
// smallvcm SCENE METHOD WIDTH ITERATIONS RUNS SEED prints JSON: images, line by line from the top, and seconds.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fstream>
#include <iterator>

#define NO_OMP
#include "config.hxx"

int main(int count, char** words) {
    if (count != 7) return 2;
    const int width = atoi(words[3]), iterations = atoi(words[4]), runs = atoi(words[5]), seed = atoi(words[6]);
    Scene scene;
    scene.LoadCornellBox(Vec2i(width, width), g_SceneConfigs[atoi(words[1])]);
    scene.BuildSceneSphere();
    Config config;
    config.mScene = &scene;
    config.mAlgorithm = Config::kAlgorithmMax;
    for (int method = 0; method < Config::kAlgorithmMax; method++)
        if (!strcmp(words[2], Config::GetAcronym(Config::Algorithm(method)))) config.mAlgorithm = Config::Algorithm(method);
    if (config.mAlgorithm == Config::kAlgorithmMax) return 2;
    config.mRadiusFactor = 0.003f;
    config.mRadiusAlpha = 0.75f;

    std::string seconds;
    printf("{\"images\":[");
    for (int run = 0; run < runs; run++) {
        const clock_t start = clock();
        AbstractRenderer* renderer = CreateRenderer(config, seed + run);
        renderer->mMinPathLength = 0;
        renderer->mMaxPathLength = 10;
        for (int iteration = 0; iteration < iterations; iteration++) renderer->RunIteration(iteration);
        Framebuffer film;
        renderer->GetFramebuffer(film);
        delete renderer;
        seconds += (run ? "," : "") + std::to_string(double(clock() - start) / CLOCKS_PER_SEC);

        // Its numbers are read only from a file that it writes.
        const std::string file = std::string(words[0]) + ".pfm";
        film.SavePFM(file.c_str());
        std::ifstream stream(file, std::ios::binary);
        const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
        const size_t numbers = size_t(3) * width * width;
        std::vector<float> film_numbers(numbers);
        memcpy(film_numbers.data(), bytes.data() + bytes.size() - numbers * sizeof(float), numbers * sizeof(float));
        printf("%s[", run ? "," : "");
        for (size_t at = 0; at < numbers; at++) printf("%s%.9g", at ? "," : "", film_numbers[at]);
        printf("]");
    }
    printf("],\"seconds\":[%s]}\n", seconds.c_str());
    return 0;
}
