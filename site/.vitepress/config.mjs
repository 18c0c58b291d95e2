// The site of ./dev docs: pages from build/pages, which pages.py gathers, to build/docs.
import { readFileSync } from 'node:fs'
import { fileURLToPath } from 'node:url'
import { defineConfig } from 'vitepress'

const build = fileURLToPath(new URL('../../build', import.meta.url))
const headers = JSON.parse(readFileSync(`${build}/pages/headers.json`, 'utf8'))

const drawn = new Map()

export default defineConfig({
  title: 'Poise',
  description: 'How to turn a held object so that its fingers press least.',
  lang: 'en-GB',
  base: process.env.BASE ?? '/', // BASE=/poise/ ./dev docs for a site in a folder
  srcDir: `${build}/pages`,
  outDir: `${build}/docs`,
  cacheDir: `${build}/vitepress`,
  vite: { build: { chunkSizeWarningLimit: 2000 } },
  head: [
    // No request may leave the site.
    ['meta', { 'http-equiv': 'Content-Security-Policy', content: "default-src 'self' 'unsafe-inline' data: blob:" }],
    ['link', { rel: 'icon', href: 'data:,' }],
  ],
  markdown: {
    math: true,
    // Every page is rendered three times: drawing a formula takes longest, so it is drawn once.
    config: (md) => {
      for (const rule of ['math_inline', 'math_block']) {
        const draw = md.renderer.rules[rule]
        md.renderer.rules[rule] = (tokens, index, ...rest) => {
          const key = `${rule} ${tokens[index].content}`
          if (!drawn.has(key)) drawn.set(key, draw(tokens, index, ...rest))
          return drawn.get(key)
        }
      }
    },
    // Anchors as on GitHub, so that links hold in both places.
    anchor: { slugify: (text) => text.trim().toLowerCase().replace(/&\w+;|[^\p{L}\p{N}\p{M}_\- ]/gu, '').replace(/ /g, '-') },
  },
  themeConfig: {
    search: { provider: 'local' },
    outline: [2, 3],
    externalLinkIcon: true,
    nav: [
      { text: 'Start', link: '/' },
      { text: 'Theory', link: '/theory' },
      { text: 'Command line', link: '/command-line' },
      { text: 'C++', link: '/reference/cpp/' },
      { text: 'Python', link: '/python' },
      { text: 'Page', link: '/playground' },
    ],
    sidebar: [
      {
        items: [
          { text: 'Start', link: '/' },
          { text: 'Take hold of an object', link: '/playground' },
          { text: 'Examples', link: '/examples' },
        ],
      },
      {
        text: 'Ideas',
        items: [
          { text: 'Theory', link: '/theory' },
          { text: 'The certificate', link: '/certificate' },
          { text: 'The paper', link: '/paper' },
        ],
      },
      {
        text: 'Use',
        items: [
          { text: 'The grasp file', link: '/grasp-file' },
          { text: 'The command line', link: '/command-line' },
          { text: 'Python', link: '/python' },
          { text: 'Many grasps', link: '/scale' },
        ],
      },
      {
        text: 'Reference',
        items: [
          {
            text: 'C++',
            link: '/reference/cpp/',
            collapsed: true,
            items: headers.map((name) => ({ text: `poise/${name}.hpp`, link: `/reference/cpp/${name}` })),
          },
          { text: 'Python', link: '/reference/python' },
        ],
      },
      {
        text: 'Project',
        items: [
          { text: 'Changes', link: '/changelog' },
          { text: 'Working on Poise', link: '/contributing' },
        ],
      },
    ],
  },
})
