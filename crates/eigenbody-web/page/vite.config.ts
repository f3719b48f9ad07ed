import { defineConfig } from "vitest/config";

// Names without hashes: the committed bundle then changes only where the sources do.
export default defineConfig({
  build: {
    target: "es2022",
    modulePreload: false,
    reportCompressedSize: false,
    license: { fileName: "assets/licenses.md" },
    rolldownOptions: {
      output: {
        entryFileNames: "assets/explorer.js",
        chunkFileNames: "assets/[name].js",
        assetFileNames: "assets/explorer[extname]",
        codeSplitting: false,
      },
    },
  },
  test: { include: ["src/**/*.test.ts"] },
});
