import { defineConfig, type Plugin } from "vitest/config";

/**
 * `EXPLORER=http://127.0.0.1:PORT npm run dev`: the sources, live, before the server of `eigenbody serve --port PORT`.
 *
 * That server answers its own page alone, so requests go to it as if they were that page's.
 */
function served(at: string | undefined): Plugin | null {
  if (!at) return null;
  return {
    name: "served",
    config: () => ({
      server: {
        proxy: {
          "/api": {
            target: at,
            changeOrigin: true,
            configure: (proxy) => void proxy.on("proxyReq", (request) => ["origin", "referer", "sec-fetch-site"].forEach((name) => request.removeHeader(name))),
          },
        },
      },
    }),
    transformIndexHtml: async (html) => {
      const token = /name="eigenbody-token" content="([^"]*)"/.exec(await (await fetch(at)).text())?.[1] ?? "";
      return html.replace('name="eigenbody-token" content=""', `name="eigenbody-token" content="${token}"`);
    },
  };
}

// Names without hashes: the committed bundle then changes only where the sources do.
export default defineConfig({
  plugins: [served(process.env["EXPLORER"])],
  build: {
    target: "es2022",
    modulePreload: false,
    reportCompressedSize: false,
    chunkSizeWarningLimit: 1000,
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
