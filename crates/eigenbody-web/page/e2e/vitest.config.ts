import { defineConfig } from "vitest/config";

// One browser and one server at a time: the machine may be small.
export default defineConfig({
  test: { include: ["e2e/**/*.e2e.ts"], testTimeout: 120_000, hookTimeout: 120_000, fileParallelism: false, reporters: ["verbose"] },
});
